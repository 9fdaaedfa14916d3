#include <algorithm>
#include <utility>

#include "geometry/bvh/clustering.hpp"

namespace navjit::bvh {
namespace {

/// A box that is in no cluster yet.
struct Left {
  Vec3 centre;
  double distance2;  ///< from the point of interest
  std::uint32_t index;
};

bool nearer(const Left& a, const Left& b) {
  return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.index < b.index;
}

void measure_from(const Vec3& p, std::span<Left> left) {
  for (Left& box : left) {
    const double x = box.centre.x - p.x, y = box.centre.y - p.y, z = box.centre.z - p.z;
    box.distance2 = x * x + y * y + z * z;
  }
}

Vec3 mean(std::span<const Left> left) {
  double x = 0, y = 0, z = 0;
  for (const Left& box : left) {
    x += box.centre.x;
    y += box.centre.y;
    z += box.centre.z;
  }
  const auto n = static_cast<double>(left.size());
  return {x / n, y / n, z / n};
}

/// The centre that is furthest away; the first of several that are equally far.
Vec3 furthest(std::span<const Left> left) {
  return std::max_element(left.begin(), left.end(),
                          [](const Left& a, const Left& b) {
                            return a.distance2 != b.distance2 ? a.distance2 < b.distance2
                                                              : a.index > b.index;
                          })
      ->centre;
}

}  // namespace

Clusters cluster_by_furthest(std::span<const Extent> boxes, std::uint32_t capacity) {
  Clusters clusters{{}, {0}};
  clusters.order.reserve(boxes.size());
  std::vector<Left> all;
  for (const Extent& box : boxes) {
    all.push_back({bounded_centre(box), 0, static_cast<std::uint32_t>(all.size())});
  }
  std::span<Left> left(all);
  while (!left.empty()) {
    const std::size_t size = std::min<std::size_t>(capacity, left.size());
    if (size < left.size()) {
      measure_from(mean(left), left);
      measure_from(furthest(left), left);
      std::nth_element(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(size), left.end(),
                       nearer);
    }
    const auto members = clusters.order.insert(clusters.order.end(), size, 0);
    std::transform(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(size), members,
                   [](const Left& box) { return box.index; });
    std::sort(members, clusters.order.end());
    clusters.begin.push_back(static_cast<std::uint32_t>(clusters.order.size()));
    left = left.subspan(size);
  }
  return clusters;
}

}  // namespace navjit::bvh
