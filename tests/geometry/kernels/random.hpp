// Random numbers, points and directions for tests of geometry.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>

#include "geometry/solids/solid.hpp"

namespace navjit::test {

/// How often a property is tried. The factor NAVJIT_TEST_SCALE of the environment raises it, to
/// look for rare faults.
inline int scaled(int count) {
  const char* text = std::getenv("NAVJIT_TEST_SCALE");
  const double scale = text == nullptr ? 1 : std::strtod(text, nullptr);
  return scale > 0 ? std::max(1, static_cast<int>(std::min(count * scale, 2e9))) : count;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  bool chance(double p) { return uniform(0, 1) < p; }
  /// Spread evenly over the logarithm.
  double scale(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  Direction direction() {
    const double z = uniform(-1, 1), phi = uniform(0, 2 * std::numbers::pi);
    const double rho = std::sqrt(1 - z * z);
    return kernels::make_direction(rho * std::cos(phi), rho * std::sin(phi), z);
  }
  /// Now and then along an axis, or nearly across one.
  Direction any_direction() {
    const Direction v = direction();
    switch (integer(0, 9)) {
      case 0: {
        double c[3] = {0, 0, 0};
        c[integer(0, 2)] = chance(0.5) ? 1 : -1;
        return kernels::make_direction(c[0], c[1], c[2]);
      }
      case 1: {
        const double norm = std::hypot(v.x, v.y);
        return kernels::make_direction(v.x / norm, v.y / norm, 0.0);
      }
      case 2: {
        const double slope = (chance(0.5) ? 1 : -1) * scale(1e-12, 1e-2);
        const double norm = std::hypot(v.x, v.y, slope);
        return kernels::make_direction(v.x / norm, v.y / norm, slope / norm);
      }
      case 3: {
        const double slant = scale(1e-12, 1e-2);
        const double z = chance(0.5) ? 1 : -1, norm = std::hypot(v.x * slant, v.y * slant, z);
        return kernels::make_direction(v.x * slant / norm, v.y * slant / norm, z / norm);
      }
      default:
        return v;
    }
  }
  Vec3 point_in(const Extent& e, double margin) {
    const auto one = [&](double low, double high) {
      const double extra = margin * (high - low);
      return uniform(low - extra, high + extra);
    };
    return {one(e.min.x, e.max.x), one(e.min.y, e.max.y), one(e.min.z, e.max.z)};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace navjit::test
