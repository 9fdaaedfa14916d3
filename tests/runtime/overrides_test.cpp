#include "runtime/overrides.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "navjit/runtime.hpp"
#include "runtime/transport.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

TEST(Overrides, AreParsedAndComplainedAbout) {
  const World world = tests::mixed_world();
  const auto [o, complaints] =
      parse_overrides(world, "stack=off,plate=all,nobody=off,tile=fast,ring");
  EXPECT_EQ(o.size(), 2U);
  EXPECT_EQ(o.at(1), Variant::off);
  EXPECT_EQ(o.at(2), Variant::all);
  EXPECT_NE(
      complaints.find("'tile=fast': NAME=off, all, lanes, nest, rings, wires, grid, boxes, scan, "
                      "groups, tree or layers is needed"),
      std::string::npos)
      << complaints;
  EXPECT_EQ(candidates_of(Variant::wires), Candidates::wires);
  EXPECT_EQ(candidates_of(Variant::off), std::nullopt);
  EXPECT_EQ(std::count(complaints.begin(), complaints.end(), '\n'), 3) << complaints;
  const auto round =
      parse_overrides(world, "stack=nest,plate=lanes,plate=rings,world=wires").variants;
  EXPECT_EQ(round.at(1), Variant::nest);
  EXPECT_EQ(round.at(2), Variant::rings);
  EXPECT_EQ(round.at(0), Variant::wires);
  const auto every = parse_overrides(world, "*=off,stack=grid").variants;
  EXPECT_EQ(every.size(), world.volumes.size());
  EXPECT_EQ(every.at(0), Variant::off);
  EXPECT_EQ(every.at(1), Variant::grid);
  EXPECT_TRUE(parse_overrides(world, "").variants.empty());
}

TEST(Overrides, FromTheEnvironmentForceScenes) {
  setenv(overrides_variable, "*=off,plate=all", 1);
  RuntimeOptions options;
  options.jit = JitMode::wait;
  Runtime runtime(tests::mixed_world(), options);
  unsetenv(overrides_variable);
  Navigator navigator = runtime.navigator();
  for (double x = -99; x < 99; x += 0.37) {
    transport(navigator, {{x, -40.3, -99}, {0, 0, 1}}, 1e-11);
    transport(navigator, {{-99, -40.3, x}, {1, 0, 0}}, 1e-11);
  }
  std::size_t specialised = 0;
  for (const SceneReport& scene : runtime.report().scenes) {
    if (scene.status == SceneStatus::specialised) {
      ++specialised;
      EXPECT_EQ(scene.volume, "plate");
    } else {
      EXPECT_EQ(scene.status, SceneStatus::unprofitable);
      EXPECT_NE(scene.note.find("NAVJIT_SCENES"), std::string::npos);
    }
  }
  EXPECT_EQ(specialised, 1U);
}

}  // namespace
}  // namespace navjit
