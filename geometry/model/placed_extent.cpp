#include "geometry/model/placed_extent.hpp"

#include <algorithm>

#include "geometry/solids/moved_box.hpp"

namespace navjit {

Extent placed_extent(const Solid& solid, const Transformation& t) {
  return moved_box(solid.extent, t.translation, t.rotation);
}

Vec3 half_lengths_around(const World& world, std::span<const Placement> placements) {
  Vec3 half{0, 0, 0};
  for (const Placement& placement : placements) {
    const Extent e = placed_extent(world.volumes[placement.volume].solid, placement.transformation);
    half = {std::max({half.x, -e.min.x, e.max.x}), std::max({half.y, -e.min.y, e.max.y}),
            std::max({half.z, -e.min.z, e.max.z})};
  }
  return half;
}

}  // namespace navjit
