// States of what is left correspond to touchables of the original.
#include <gtest/gtest.h>

#include <random>

#include "tests/observe/material_trace.hpp"
#include "tests/observe/worlds.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

using tests::Shell;

TEST(Original, HasThePathAndTheCopyNumbers) {
  Shell world;
  const VolumeId tray = world.box("tray", 60, 25, 25, world.air);
  world.builder.place(world.shell, tray, placed_at({-30, 0, 0}), 1);
  world.builder.place(tray, world.hall, placed_at({0, 30, 0}), 10);
  world.builder.place(tray, world.hall, placed_at({0, -30, 0}), 20);
  const ObservedDetector seen = world.observed();
  EXPECT_EQ(seen.report().dissolved, 3U);  // the tray's shell, and two trays
  const Detector& whole = seen.original();
  Runtime all(whole, {.jit = JitMode::off}), less(seen.detector(), {.jit = JitMode::off});
  Navigator every = all.navigator(), left = less.navigator();
  std::mt19937_64 random(4);
  std::size_t in_bricks = 0, in_shells = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto any = [&] { return tests::uniform(random, -70, 70); };
    const Vec3 point{any(), any(), tests::uniform(random, -30, 30)};
    const Vec3 direction = tests::random_direction(random);
    const State is = every.locate(point, direction);
    const State state = left.locate(point, direction);
    EXPECT_EQ(seen.original(state, point, direction), is);
    const State touchable = seen.original(state);
    EXPECT_EQ(touchable.volume(), state.volume());
    if (is.volume() == world.brick) {
      ++in_bricks;
      EXPECT_EQ(touchable, is);
      // Of both trees the path is the same.
      EXPECT_EQ(seen.detector().path_of(state), whole.path_of(is));
    } else {
      EXPECT_EQ(touchable.touchable(), 0U);
      in_shells += is.volume() == world.shell ? 1 : 0;
    }
  }
  EXPECT_GT(in_bricks, 20U);
  EXPECT_GT(in_shells, 100U);
  EXPECT_EQ(seen.original(State{}), State{});
  EXPECT_THROW(seen.original(State{1000, 0}), UsageError);
}

TEST(Original, IsTheStateItselfWhereAllIsObserved) {
  Shell world;
  world.builder.place(world.shell, world.hall);
  const ObservedDetector seen = world.observed({});
  const State brick = seen.original().state_at(std::vector<std::uint32_t>{0, 0});
  EXPECT_EQ(seen.original(brick), brick);
  EXPECT_EQ(seen.original(brick, {1, 2, 3}, {1, 0, 0}), brick);
}

}  // namespace
}  // namespace navjit
