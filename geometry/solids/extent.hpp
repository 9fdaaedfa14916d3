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

}  // namespace navjit
