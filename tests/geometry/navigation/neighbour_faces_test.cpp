// Where a track leaves a daughter, the daughter's list of neighbours is enough.
#include <gtest/gtest.h>

#include "geometry/navigation/geometry.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

TEST(NeighbourFaces, HoldThePointsOnTheFacesOfTheirDaughters) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  const Geometry geometry(world);
  int faces = 0;
  for (VolumeId v = 0; v < geometry.size(); ++v) {
    const Scene& scene = geometry.scene(v);
    if (scene.neighbour_lists.of.empty()) continue;
    const auto& lists = scene.neighbour_lists.of;
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
