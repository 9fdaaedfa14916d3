#include "geometry/surface/polygon.hpp"

#include <cmath>
#include <numeric>

namespace navjit::surface {
namespace {

/// Twice the area that the polygon surrounds, along its normal.
Vec3 area_of(std::span<const Vec3> polygon) {
  Vec3 area{0, 0, 0};
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    area += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  }
  return area;
}

}  // namespace

std::vector<std::array<std::size_t, 3>> cut(std::span<const Vec3> polygon) {
  std::vector<std::array<std::size_t, 3>> triangles;
  const Vec3 normal = area_of(polygon);
  std::vector<std::size_t> left(polygon.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  // Twice the area of a triangle as it is seen along the normal.
  const auto seen = [&](std::size_t a, std::size_t b, std::size_t c) {
    return dot(cross(polygon[b] - polygon[a], polygon[c] - polygon[a]), normal);
  };
  // Ears are cut off: corners that turn left, with no other corner within their triangle. Flat ones
  // are taken only where there is nothing else, so that no sliver hides a corner.
  while (left.size() > 3) {
    const std::size_t count = left.size();
    std::size_t ear = count;
    for (std::size_t i = 0; i < count && ear == count; ++i) {
      const std::size_t a = left[(i + count - 1) % count], b = left[i], c = left[(i + 1) % count];
      if (!(seen(a, b, c) > 0)) continue;
      bool empty = true;
      for (const std::size_t p : left) {
        if (p == a || p == b || p == c) continue;
        if (seen(a, b, p) >= 0 && seen(b, c, p) >= 0 && seen(c, a, p) >= 0 &&
            !(polygon[p] == polygon[a] || polygon[p] == polygon[b] || polygon[p] == polygon[c])) {
          empty = false;
          break;
        }
      }
      if (empty) ear = i;
    }
    for (std::size_t i = 0; i < count && ear == count; ++i) {
      const std::size_t a = left[(i + count - 1) % count], b = left[i], c = left[(i + 1) % count];
      if (seen(a, b, c) == 0) ear = i;
    }
    if (ear == count) return {};
    triangles.push_back({left[(ear + count - 1) % count], left[ear], left[(ear + 1) % count]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace navjit::surface
