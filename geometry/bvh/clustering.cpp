#include "geometry/bvh/clustering.hpp"

#include <algorithm>
#include <cmath>

namespace navjit::bvh {

Clusters cluster(Clustering clustering, std::span<const Extent> boxes, std::uint32_t capacity) {
  switch (clustering) {
    case Clustering::surface:
      break;
    case Clustering::k_means:
      return cluster_by_k_means(boxes, capacity);
    case Clustering::furthest:
      return cluster_by_furthest(boxes, capacity);
  }
  return cluster_by_surface(boxes, capacity);
}

Vec3 bounded_centre(const Extent& box) {
  const auto centre = [](double low, double high) {
    const double middle = low / 2 + high / 2;
    return std::isnan(middle) ? 0 : std::clamp(middle, -1e30, 1e30);  // -infinity + infinity
  };
  return {centre(box.min.x, box.max.x), centre(box.min.y, box.max.y), centre(box.min.z, box.max.z)};
}

}  // namespace navjit::bvh
