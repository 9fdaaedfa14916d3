#include <algorithm>
#include <numbers>

#include "geometry/solids/make.hpp"

namespace navjit {
namespace {

kernels::Plane<double> cut(const Vec3& normal, double z) {
  const double norm = std::hypot(normal.x, normal.y, normal.z);
  const kernels::Plane<double> f{normal.x / norm, normal.y / norm, normal.z / norm, 0};
  return {f.a, f.b, f.c, -f.c * z};
}
double height(const kernels::Plane<double>& f, double x, double y) {
  return -(f.a * x + f.b * y + f.d) / f.c;
}

}  // namespace

Solid make_cut_tube(std::string name, double rmin, double rmax, double hz, double start_phi,
                    double delta_phi, const Vec3& low_normal, const Vec3& high_normal) {
  detail::require_finite({rmin, rmax, hz, low_normal.x, low_normal.y, low_normal.z, high_normal.x,
                          high_normal.y, high_normal.z},
                         name);
  detail::require(rmin >= 0 && rmax > rmin && hz > 0, name,
                  "a cutTube needs 0 <= rmin < rmax and a positive length");
  detail::require(low_normal.z < 0 && high_normal.z > 0, name,
                  "the normals of a cutTube must point out of it");
  const kernels::CutTube<double> shape{rmin, rmax, cut(low_normal, -hz), cut(high_normal, hz),
                                       detail::make_wedge(start_phi, delta_phi, name)};
  if (shape.wedge.kind == 0) delta_phi = 2 * std::numbers::pi;
  // The ends are highest and lowest, and nearest to each other, at corners, or where the slope of
  // an end is along the radius.
  Extent e = detail::sector_extent(rmin, rmax, start_phi, delta_phi, INFINITY, -INFINITY);
  const auto add = [&](double r, const detail::UnitVector& u) {
    const double below = height(shape.low, r * u.x, r * u.y);
    const double above = height(shape.high, r * u.x, r * u.y);
    detail::require(below <= above, name, "the ends of a cutTube meet within it");
    e.min.z = std::min(e.min.z, below);
    e.max.z = std::max(e.max.z, above);
  };
  std::vector<double> angles{start_phi, start_phi + delta_phi};
  const auto add_slope = [&](double x, double y) {
    if (x == 0 && y == 0) return;
    for (const double turn : {0.0, std::numbers::pi}) {
      double angle = std::atan2(y, x) + turn;
      angle += 2 * std::numbers::pi * std::ceil((start_phi - angle) / (2 * std::numbers::pi));
      if (angle <= start_phi + delta_phi) angles.push_back(angle);
    }
  };
  const auto &low = shape.low, &high = shape.high;
  add_slope(low.a, low.b);
  add_slope(high.a, high.b);
  add_slope(low.a / low.c - high.a / high.c, low.b / low.c - high.b / high.c);
  for (const double angle : angles) {
    for (const double r : {rmin, rmax}) add(r, detail::unit_vector(angle));
  }
  return detail::make_solid(std::move(name), SolidKind::cut_tube, shape, e);
}

double SolidFacts<kernels::CutTube<double>>::volume(const Shape& s) {
  // The integral of the height over the sector; the height is linear in x and y.
  const auto& w = s.wedge;
  const auto at = [](const kernels::Plane<double>& f) { return -f.d / f.c; };
  const double tilt_x = s.low.a / s.low.c - s.high.a / s.high.c;
  const double tilt_y = s.low.b / s.low.c - s.high.b / s.high.c;
  const double squares = (s.rmax - s.rmin) * (s.rmax + s.rmin) / 2;
  const double cubes = (s.rmax * s.rmax * s.rmax - s.rmin * s.rmin * s.rmin) / 3;
  double volume = detail::angle_of(w) * squares * (at(s.high) - at(s.low));
  if (w.kind != 0) {
    volume += cubes * (tilt_x * (w.end_y - w.start_y) + tilt_y * (w.start_x - w.end_x));
  }
  return volume;
}

Round SolidFacts<kernels::CutTube<double>>::round(const Shape& s) {
  return {s.rmin, s.rmax, s.wedge};
}

}  // namespace navjit
