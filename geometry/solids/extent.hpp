// What is asked of boxes along the axes.
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

/// The box with `margin` (mm) more on every side.
inline Extent inflated(const Extent& e, double margin) {
  return {{e.min.x - margin, e.min.y - margin, e.min.z - margin},
          {e.max.x + margin, e.max.y + margin, e.max.z + margin}};
}

}  // namespace navjit
