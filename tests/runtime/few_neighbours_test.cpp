// Thousands of daughters with few neighbours each: the neighbours of one that was left are read
// from its list, though no cache holds all lists; but not if rows of slabs give them by arithmetic.
#include <gtest/gtest.h>

#include <cstdlib>

#include "analysis/plan.hpp"
#include "codegen/data/parts.hpp"
#include "navjit/runtime.hpp"
#include "runtime/overrides.hpp"
#include "tests/support/traces.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

/// Cells of a wafer; every other row lies on the gaps of the row before.
World wafer() {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 220, 220, 20));
  const VolumeId cell = tests::add_volume(world, "cell", make_box("cell", 2, 2, 5));
  const VolumeId tube = tests::add_volume(world, "tube", make_tube("tube", 0, 2, 5, 0, 7));
  for (int row = 0; row < 90; ++row) {
    for (int i = 0; i < 90; ++i) {
      tests::place(world, world.top, (row + i) % 7 == 0 ? tube : cell,
                   {-180 + 4.0 * i + 2 * (row % 2), -180 + 4.0 * row, 0});
    }
  }
  finish(world);
  return world;
}

TEST(FewNeighbours, AreReadFromListsButByArithmetic) {
  const World world = wafer();
  const Geometry geometry(std::make_shared<const World>(world));
  const Scene& scene = geometry.scene(0);
  ASSERT_FALSE(scene.neighbour_lists.of.empty());
  ASSERT_FALSE(scene.neighbour_lists.are_near());
  ScenePlan plan = plan_scene(geometry, analyse_world(geometry), 0);
  ASSERT_TRUE(plan.layers.found());
  codegen::Arena arena;
  plan.candidates = Candidates::layers;
  EXPECT_FALSE(codegen::reads_neighbour_lists({geometry, plan, scene, arena}));
  plan.candidates = Candidates::tree;
  EXPECT_TRUE(codegen::reads_neighbour_lists({geometry, plan, scene, arena}));
}

TEST(FewNeighbours, GiveTheGenericNavigatorsBitsEitherWay) {
  const auto world = std::make_shared<const World>(wafer());
  RuntimeOptions options = tests::eager_options(JitMode::off);
  Runtime generic(world, options);
  Navigator expected = generic.navigator();
  const std::vector<Ray> rays = tests::rays_through(*world, 5, 400);
  for (const char* search : {"*=tree", "*=layers"}) {
    SCOPED_TRACE(search);
    setenv(overrides_variable, search, 1);
    options = tests::eager_options(JitMode::wait);
    options.specialiser.constants = options.specialiser.structures = false;
    options.specialiser.solids = options.specialiser.keep_only_faster = false;
    Runtime bound(world, options);
    unsetenv(overrides_variable);
    Navigator found = bound.navigator();
    std::size_t steps = 0;
    for (const Ray& ray : rays) {
      const auto right = tests::trace(expected, ray, world->tolerance);
      ASSERT_TRUE(tests::same_bits(right, tests::trace(found, ray, world->tolerance)));
      steps += right.size();
    }
    EXPECT_GT(steps, 5 * rays.size());
    for (const SceneReport& scene : bound.report().scenes) {
      EXPECT_EQ(scene.binding, Binding::data) << scene.volume << ": " << scene.note;
    }
  }
}

}  // namespace
}  // namespace navjit
