#include "geometry/model/placed_extent.hpp"

#include <algorithm>
#include <cmath>

namespace navjit {

Extent placed_extent(const Solid& solid, const Transformation& t) {
  const Extent& e = solid.extent;
  const double centre[3] = {(e.min.x + e.max.x) / 2, (e.min.y + e.max.y) / 2,
                            (e.min.z + e.max.z) / 2};
  const double half[3] = {(e.max.x - e.min.x) / 2, (e.max.y - e.min.y) / 2,
                          (e.max.z - e.min.z) / 2};
  double low[3], high[3];
  for (int i = 0; i < 3; ++i) {
    double c = t.translation[i], h = 0;
    for (int j = 0; j < 3; ++j) {
      c += t.rotation[3 * j + i] * centre[j];
      h += std::abs(t.rotation[3 * j + i]) * half[j];
    }
    low[i] = c - h;
    high[i] = c + h;
  }
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
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
