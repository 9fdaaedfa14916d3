// Functions of boxes along the axes.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/solids/solid.hpp"

namespace navjit {

/// The largest magnitude of a bound, mm.
inline double largest_coordinate(const Extent& e) {
  double largest = 0;
  for (const double x : {e.min.x, e.min.y, e.min.z, e.max.x, e.max.y, e.max.z}) {
    largest = std::max(largest, std::abs(x));
  }
  return largest;
}

/// The box, larger by `margin` (mm) on every side.
inline Extent inflated(const Extent& e, double margin) {
  return {{e.min.x - margin, e.min.y - margin, e.min.z - margin},
          {e.max.x + margin, e.max.y + margin, e.max.z + margin}};
}

/// The smallest box around two boxes.
inline Extent merged(const Extent& a, const Extent& b) {
  return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y), std::min(a.min.z, b.min.z)},
          {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y), std::max(a.max.z, b.max.z)}};
}

/// Whether two boxes have a point in common, be it on their faces.
inline bool meet(const Extent& a, const Extent& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
         a.min.z <= b.max.z && b.min.z <= a.max.z;
}

/// Whether two boxes reach into each other by more than `depth` (mm) along every axis.
inline bool share_more_than(double depth, const Extent& a, const Extent& b) {
  const auto along = [depth](double low_a, double high_a, double low_b, double high_b) {
    return std::min(high_a, high_b) - std::max(low_a, low_b) > depth;
  };
  return along(a.min.x, a.max.x, b.min.x, b.max.x) && along(a.min.y, a.max.y, b.min.y, b.max.y) &&
         along(a.min.z, a.max.z, b.min.z, b.max.z);
}

}  // namespace navjit
