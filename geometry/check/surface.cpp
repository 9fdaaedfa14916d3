#include "geometry/check/surface.hpp"

#include <cmath>

#include "geometry/model/random.hpp"
#include "geometry/model/vector.hpp"

namespace navjit {
std::vector<Vec3> surface_points(const Solid& solid, std::size_t count, double tolerance,
                                 std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Vec3> points;
  const Vec3 centre = 0.5 * (solid.extent.min + solid.extent.max);
  const double radius = 0.5 * norm(solid.extent.max - solid.extent.min) * 1.001 + tolerance;
  // Lines with uniform directions and uniform offsets within the bounding sphere's disk: isotropic
  // lines, which meet equal areas equally often (Santalo).
  for (std::size_t line = 0; line < 40 * count && points.size() < count; ++line) {
    const Vec3 v = unit_vector(random);
    const Vec3 a = std::abs(v.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    Vec3 e1{v.y * a.z - v.z * a.y, v.z * a.x - v.x * a.z, v.x * a.y - v.y * a.x};
    e1 = (1 / norm(e1)) * e1;
    const Vec3 e2{v.y * e1.z - v.z * e1.y, v.z * e1.x - v.x * e1.z, v.x * e1.y - v.y * e1.x};
    const double r = radius * std::sqrt(uniform(random, 0, 1));
    const double phi = uniform(random, 0, 2 * std::numbers::pi);
    Vec3 p = centre + (r * std::cos(phi)) * e1 + (r * std::sin(phi)) * e2 + (-radius) * v;
    const Direction d = kernels::make_direction(v.x, v.y, v.z);
    for (int crossing = 0; crossing < 64 && points.size() < count; ++crossing) {
      const double in = distance_to_in(solid.any(), p, d, tolerance);
      if (!(in < 4 * radius)) break;
      p += in * v;
      points.push_back(p);
      const double out = distance_to_out(solid.any(), p, d, tolerance);
      if (!(out < 4 * radius) || !(in + out > 0)) break;
      p += out * v;
      if (points.size() < count) points.push_back(p);
    }
  }
  return points;
}

}  // namespace navjit
