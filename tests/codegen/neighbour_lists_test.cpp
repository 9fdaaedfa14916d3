// Where a track leaves a daughter, the daughter's list of neighbours serves.
#include <gtest/gtest.h>

#include "analysis/plan.hpp"
#include "codegen/data/parts.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

TEST(NeighbourListsBound, HoldThePointsOnTheFacesOfTheirDaughters) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  const Geometry geometry(world);
  const WorldFacts facts = analyse_world(geometry);
  int faces = 0;
  for (VolumeId v = 0; v < geometry.size(); ++v) {
    const Scene& scene = geometry.scene(v);
    if (scene.neighbour_lists.of.empty()) continue;
    const ScenePlan plan = plan_scene(geometry, facts, v);
    codegen::Arena arena;
    const auto* lists = codegen::make_neighbour_lists({geometry, plan, scene, arena});
    for (std::size_t k = 0; k < scene.daughters.size(); ++k) {
      const Daughter& d = scene.daughters[k];
      if (d.solid.kind != SolidKind::box || d.transformation.rotated) continue;
      const auto& box = *static_cast<const kernels::Box<double>*>(d.solid.shape);
      const double half[3] = {box.hx, box.hy, box.hz};
      for (int face = 0; face < 6; ++face) {
        double p[3];
        for (int axis = 0; axis < 3; ++axis) p[axis] = d.transformation.translation[axis];
        p[face / 2] += face % 2 == 0 ? half[face / 2] : -half[face / 2];
        EXPECT_TRUE(is_there(lists[k], {p[0], p[1], p[2]})) << v << ' ' << k << ' ' << face;
        ++faces;
      }
    }
  }
  EXPECT_GT(faces, 100);
}

}  // namespace
}  // namespace navjit
