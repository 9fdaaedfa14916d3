#include <algorithm>
#include <numbers>
#include <optional>

#include "geometry/solids/make.hpp"

namespace navjit {
namespace {

/// The plane nearest to four corners, anticlockwise seen from outside; nothing if they are not in
/// one plane. The normal is the product of the diagonals, which exist even if one edge has no
/// length.
std::optional<kernels::Plane<double>> side_plane(const Vec3& p1, const Vec3& p2, const Vec3& p3,
                                                 const Vec3& p4, double scale,
                                                 const std::string& name) {
  const double ux = p4.x - p2.x, uy = p4.y - p2.y, uz = p4.z - p2.z;
  const double wx = p3.x - p1.x, wy = p3.y - p1.y, wz = p3.z - p1.z;
  double a = uy * wz - uz * wy, b = uz * wx - ux * wz, c = ux * wy - uy * wx;
  double norm = std::hypot(a, b, c);
  detail::require(norm > 0, name, "a side of the trap has no area");
  // Removes what is left of components that should be zero.
  for (double* component : {&a, &b, &c}) {
    *component = std::abs(*component) < 1e-15 * norm ? 0 : *component / norm;
  }
  const double d = -(a * (p1.x + p2.x + p3.x + p4.x) + b * (p1.y + p2.y + p3.y + p4.y) +
                     c * (p1.z + p2.z + p3.z + p4.z)) /
                   4;
  for (const Vec3& p : {p1, p2, p3, p4}) {
    const double off = std::abs(a * p.x + b * p.y + c * p.z + d);
    if (!(off < 1e-5 * scale || off < 1e-5)) return std::nullopt;
  }
  return kernels::Plane<double>{a, b, c, d};
}

/// The corner where two sides meet at a height; not finite if they do not meet.
Vec3 corner_of(const kernels::Plane<double>& f, const kernels::Plane<double>& g, double z) {
  const double area = f.a * g.b - f.b * g.a;
  const double at_f = -(f.c * z + f.d), at_g = -(g.c * z + g.d);
  return {(at_f * g.b - f.b * at_g) / area, (f.a * at_g - at_f * g.a) / area, z};
}

/// The area of the trapezoid at height z: in every section the sides across y are parallel to x.
double area_at(const kernels::Trap<double>& s, double z) {
  const auto y_on = [&](const kernels::Plane<double>& f) { return -(f.c * z + f.d) / f.b; };
  const auto x_on = [&](const kernels::Plane<double>& f, double y) {
    return -(f.b * y + f.c * z + f.d) / f.a;
  };
  const double y1 = y_on(s.y_minus), y2 = y_on(s.y_plus), y = (y1 + y2) / 2;
  return (y2 - y1) * (x_on(s.x_plus, y) - x_on(s.x_minus, y));
}

}  // namespace

Solid make_trap(std::string name, double hz, double theta, double phi, double hy1, double hx1,
                double hx2, double alpha1, double hy2, double hx3, double hx4, double alpha2) {
  detail::require_finite({hz, theta, phi, hy1, hx1, hx2, alpha1, hy2, hx3, hx4, alpha2}, name);
  detail::require(hz > 0 && hy1 > 0 && hy2 > 0 && hx1 > 0 && hx2 > 0 && hx3 > 0 && hx4 > 0, name,
                  "a trap needs positive lengths");
  constexpr double right_angle = std::numbers::pi / 2;
  detail::require(std::abs(theta) < right_angle && std::abs(alpha1) < right_angle &&
                      std::abs(alpha2) < right_angle,
                  name, "the angles theta and alpha of a trap must be between -90 and 90 degrees");
  const detail::UnitVector azimuth = detail::unit_vector(phi);
  const double x = hz * (std::tan(theta) * azimuth.x), y = hz * (std::tan(theta) * azimuth.y);
  const double slant1 = hy1 * std::tan(alpha1), slant2 = hy2 * std::tan(alpha2);
  const Vec3 corners[8] = {{-x - slant1 - hx1, -y - hy1, -hz}, {-x - slant1 + hx1, -y - hy1, -hz},
                           {-x + slant1 - hx2, -y + hy1, -hz}, {-x + slant1 + hx2, -y + hy1, -hz},
                           {x - slant2 - hx3, y - hy2, hz},    {x - slant2 + hx3, y - hy2, hz},
                           {x + slant2 - hx4, y + hy2, hz},    {x + slant2 + hx4, y + hy2, hz}};
  Extent e{corners[0], corners[0]};
  for (const Vec3& c : corners) e = merged(e, {c, c});
  const double scale = std::max({e.max.x - e.min.x, e.max.y - e.min.y, e.max.z - e.min.z});
  detail::require(std::isfinite(scale), name, "the trap is too large");
  const auto side = [&](int i, int j, int k, int l) {
    return side_plane(corners[i], corners[j], corners[k], corners[l], scale, name);
  };
  const auto front = side(0, 4, 5, 1), back = side(2, 3, 7, 6);
  const auto left = side(0, 2, 6, 4), right = side(1, 5, 7, 3);
  bool closed = front && back && left && right;
  if (closed) {
    // The given corners are not exactly on the planes: the solid has the planes' own corners.
    for (const auto& along : {*front, *back}) {
      for (const auto& across : {*left, *right}) {
        for (const double z : {-hz, hz}) {
          const Vec3 c = corner_of(along, across, z);
          closed = closed && std::isfinite(c.x) && std::isfinite(c.y);
          e = merged(e, {c, c});
        }
      }
    }
  }
  if (!closed) {
    PlanarPoint around[8];
    constexpr int order[8] = {0, 1, 3, 2, 4, 5, 7, 6};
    for (int i = 0; i < 8; ++i) around[i] = {corners[order[i]].x, corners[order[i]].y};
    return make_arb8(std::move(name), hz, around);
  }
  const kernels::Trap<double> shape{hz, *front, *back, *left, *right};
  return detail::make_solid(std::move(name), SolidKind::trap, shape, e);
}

double SolidFacts<kernels::Trap<double>>::volume(const Shape& s) {
  // The area is quadratic in z.
  return s.hz / 3 * (area_at(s, -s.hz) + 4 * area_at(s, 0) + area_at(s, s.hz));
}

std::optional<double> SolidFacts<kernels::Trap<double>>::error(const Shape& s,
                                                               const KernelUse& use) {
  return std::max({face_error::slab(s.hz, use), face_error::plane(s.x_minus.d, use),
                   face_error::plane(s.x_plus.d, use), face_error::plane(s.y_minus.d, use),
                   face_error::plane(s.y_plus.d, use)});
}

}  // namespace navjit
