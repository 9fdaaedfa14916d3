#include "codegen/data/parts.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "analysis/plan.hpp"
#include "tests/support/worlds.hpp"

namespace navjit::codegen {
namespace {

/// Two volumes have solids of their own with the same numbers, as exported detectors do.
TEST(Parts, EqualSolidsAndRotationsOfASceneAreOne) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 100, 100, 100));
  const VolumeId a = tests::add_volume(world, "a", make_box("a", 1, 2, 3));
  const VolumeId b = tests::add_volume(world, "b", make_box("b", 1, 2, 3));
  const VolumeId c = tests::add_volume(world, "c", make_box("c", 1, 2, 4));
  tests::place(world, world.top, a, {-40, 0, 0}, {0, 0, 0.5});
  tests::place(world, world.top, b, {0, 0, 0}, {0, 0, 0.5});
  tests::place(world, world.top, c, {40, 0, 0}, {0, 0, 0.25});
  finish(world);
  const Geometry geometry(std::make_shared<const World>(std::move(world)));
  ASSERT_NE(geometry.scene(a).solid.shape, geometry.scene(b).solid.shape);
  const WorldFacts facts = analyse_world(geometry);
  const VolumeId top = geometry.world().top;
  const ScenePlan plan = plan_scene(geometry, facts, top);
  Arena arena;
  AnyDaughters daughters;
  make({geometry, plan, geometry.scene(top), arena}, daughters);
  ASSERT_EQ(daughters.count, 3U);
  EXPECT_EQ(daughters.at[0].solid.shape, daughters.at[1].solid.shape);
  EXPECT_NE(daughters.at[0].solid.shape, daughters.at[2].solid.shape);
  EXPECT_EQ(daughters.at[0].rotation, daughters.at[1].rotation);
  EXPECT_NE(daughters.at[0].rotation, daughters.at[2].rotation);
  EXPECT_EQ(daughters.at[2].solid.box().hz, 4);
}

}  // namespace
}  // namespace navjit::codegen
