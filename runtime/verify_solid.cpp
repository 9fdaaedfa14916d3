#include "runtime/verify_solid.hpp"

#include <cstdio>
#include <random>

#include "geometry/model/random.hpp"
#include "geometry/navigation/navigation_stack.hpp"

namespace navjit {
namespace {

/// A point in the box or within a tenth of its size around it, more than half of the time in the
/// plane of a face.
Vec3 point_about(std::mt19937_64& random, const Extent& box) {
  const Vec3 about = 0.1 * (box.max - box.min);
  const auto in = [&](double low, double high, double more) {
    switch (random() % 8) {
      case 0:
        return low;
      case 1:
        return high;
      default:
        return uniform(random, low - more, high + more);
    }
  };
  return {in(box.min.x, box.max.x, about.x), in(box.min.y, box.max.y, about.y),
          in(box.min.z, box.max.z, about.z)};
}

/// A random direction, one in four along an axis.
Vec3 some_direction(std::mt19937_64& random) {
  const double way = random() % 2 == 0 ? 1 : -1;
  switch (random() % 12) {
    case 0:
      return {way, 0, 0};
    case 1:
      return {0, way, 0};
    case 2:
      return {0, 0, way};
    default:
      return unit_vector(random);
  }
}

}  // namespace

std::string verify_solid(const kernels::AnySolid<double>& solid, const kernels::SolidCode& code,
                         const Extent& extent, double tolerance, int points, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::string problem;
  const auto compare = [&](const char* what, double got, double expected, const Vec3& p,
                           const Vec3& d) {
    if (!problem.empty() || kernels::same_bits(got, expected)) return;
    char text[512];
    std::snprintf(text, sizeof text,
                  "%s is %.17g instead of %.17g at (%.17g, %.17g, %.17g) along "
                  "(%.17g, %.17g, %.17g)",
                  what, got, expected, p.x, p.y, p.z, d.x, d.y, d.z);
    problem = text;
  };
  for (int n = 0; n < points && problem.empty(); ++n) {
    Vec3 p = point_about(random, extent);
    const Vec3 d = some_direction(random);
    const Direction v = kernels::make_direction(d.x, d.y, d.z);
    // Compares here, where the ray enters the solid, and where it leaves the solid.
    for (int at = 0; at < 3; ++at) {
      const bool held = contains(solid, p, v, tolerance);
      compare("contains", code.contains(code.data, p, v), held, p, d);
      if (code.safety_to_in != nullptr) {
        compare("safety_to_in", code.safety_to_in(code.data, p), safety_to_in(solid, p), p, d);
        compare("safety_to_out", code.safety_to_out(code.data, p), safety_to_out(solid, p), p, d);
      }
      const double in = distance_to_in(solid, p, v, tolerance);
      compare("distance_to_in", code.distance_to_in(code.data, p, v), in, p, d);
      double next = in;
      if (held) {
        next = distance_to_out(solid, p, v, tolerance);
        compare("distance_to_out", code.distance_to_out(code.data, p, v), next, p, d);
      }
      if (!(next < 1e300)) break;
      p = p + next * d;
    }
  }
  return problem;
}

}  // namespace navjit
