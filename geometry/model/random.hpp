// Random numbers that, unlike the standard distributions, are the same with every library.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "geometry/solids/solid.hpp"

namespace navjit {

inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

/// A unit vector with an isotropic distribution.
inline Vec3 unit_vector(std::mt19937_64& random) {
  const double c = uniform(random, -1, 1), phi = uniform(random, 0, 2 * std::numbers::pi);
  const double s = std::sqrt(1 - c * c);
  return {s * std::cos(phi), s * std::sin(phi), c};
}

/// A point in a box.
inline Vec3 point_in(std::mt19937_64& random, const Extent& e) {
  const double x = uniform(random, e.min.x, e.max.x), y = uniform(random, e.min.y, e.max.y);
  return {x, y, uniform(random, e.min.z, e.max.z)};
}

}  // namespace navjit
