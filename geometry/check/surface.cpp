#include "geometry/check/surface.hpp"

#include <cmath>

#include "geometry/check/chords.hpp"
#include "geometry/model/random.hpp"
#include "navjit/vector.hpp"

namespace navjit {
namespace {

/// A point and a unit vector.
struct Line {
  Vec3 p, v;
};

/// A line with a uniform direction and a uniform offset within the bounding sphere's disk. Such
/// isotropic lines meet equal areas equally often (Santalo).
Line isotropic_line(std::mt19937_64& random, const Vec3& centre, double radius) {
  const Vec3 v = unit_vector(random);
  const Vec3 a = std::abs(v.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  Vec3 e1{v.y * a.z - v.z * a.y, v.z * a.x - v.x * a.z, v.x * a.y - v.y * a.x};
  e1 = (1 / norm(e1)) * e1;
  const Vec3 e2{v.y * e1.z - v.z * e1.y, v.z * e1.x - v.x * e1.z, v.x * e1.y - v.y * e1.x};
  const double r = radius * std::sqrt(uniform(random, 0, 1));
  const double phi = uniform(random, 0, 2 * std::numbers::pi);
  return {centre + (r * std::cos(phi)) * e1 + (r * std::sin(phi)) * e2 + (-radius) * v, v};
}

/// A line through the extent itself, along its long sides or in any direction: it meets a wire or a
/// hoop that isotropic lines miss.
Line line_through(std::mt19937_64& random, const Extent& e, double radius, bool along) {
  const Vec3 p = point_in(random, e);
  Vec3 v = along ? point_in(random, e) - p : unit_vector(random);
  const double length = norm(v);
  v = length > 0 ? (1 / length) * v : unit_vector(random);
  v = (1 / norm(v)) * v;
  return {p + (-2 * radius) * v, v};
}

/// A line through the extent along the axis of this number: often it is an end that sticks out.
Line line_along_axis(std::mt19937_64& random, const Extent& e, double radius, int axis) {
  const Vec3 v{axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
  return {point_in(random, e) + (-2 * radius) * v, v};
}

}  // namespace

SolidPoints sample_points(const Solid& solid, std::size_t count, double tolerance,
                          std::uint64_t seed) {
  std::mt19937_64 random(seed);
  SolidPoints points;
  const Vec3 centre = 0.5 * (solid.extent.min + solid.extent.max);
  const double radius = 0.5 * norm(solid.extent.max - solid.extent.min) * 1.001 + tolerance;
  const auto add = [&](const Line& line) {
    for (const Chord& c : chords_along(solid.any(), line.p, line.v, 4 * radius, tolerance)) {
      if (points.surface.size() < count) points.surface.push_back(line.p + c.enter * line.v);
      if (points.surface.size() < count) points.surface.push_back(line.p + c.leave * line.v);
      if (points.interior.size() < count / 2) {
        points.interior.push_back(line.p + 0.5 * (c.enter + c.leave) * line.v);
      }
    }
  };
  for (int i = 0; i < 24; ++i) add(line_along_axis(random, solid.extent, radius, i % 3));
  for (std::size_t i = 0; i < 40 * count && points.surface.size() < count; ++i) {
    add(isotropic_line(random, centre, radius));
  }
  for (std::size_t i = 0; i < 40 * count && points.surface.size() < count; ++i) {
    add(line_through(random, solid.extent, radius, i % 2 == 0));
  }
  return points;
}

std::vector<Vec3> corner_points(const Solid& solid, double tolerance) {
  const Vec3 half = 0.5 * (solid.extent.max - solid.extent.min);
  const Vec3 centre = solid.extent.min + half;
  std::vector<Vec3> points;
  for (int i = 0; i < 27; ++i) {
    const Vec3 p =
        centre + Vec3{(i % 3 - 1) * half.x, (i / 3 % 3 - 1) * half.y, (i / 9 - 1) * half.z};
    if (kernels::inside(solid.any(), p, tolerance) != Side::outside) points.push_back(p);
  }
  return points;
}

std::vector<Vec3> bore_points(const Solid& solid, double tolerance) {
  constexpr int points_of_axis = 100;
  const Extent& e = solid.extent;
  std::vector<Vec3> points;
  for (int i = 0; i < 3 * points_of_axis; ++i) {
    const double part = (i / 3 + 0.5) / points_of_axis;
    const Vec3 on_diagonal = e.min + part * (e.max - e.min);
    const Vec3 p{i % 3 == 0 ? on_diagonal.x : 0, i % 3 == 1 ? on_diagonal.y : 0,
                 i % 3 == 2 ? on_diagonal.z : 0};
    if (kernels::inside(solid.any(), p, tolerance) == Side::outside) points.push_back(p);
  }
  return points;
}

std::vector<Vec3> surface_points(const Solid& solid, std::size_t count, double tolerance,
                                 std::uint64_t seed) {
  return sample_points(solid, count, tolerance, seed).surface;
}

}  // namespace navjit
