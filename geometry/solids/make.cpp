#include "geometry/solids/make.hpp"

#include <algorithm>
#include <numbers>

namespace navjit::detail {
// Computed cos and sin of multiples of a right angle are off from 0 and 1 by a rounding; but faces
// of half and quarter tubes are meant to lie on the axes.
UnitVector unit_vector(double angle) {
  const double quarter = angle / (std::numbers::pi / 2);
  const double nearest = std::round(quarter);
  if (std::abs(quarter - nearest) < 1e-12) {
    constexpr UnitVector axes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    return axes[static_cast<long long>(nearest) & 3];
  }
  return {std::cos(angle), std::sin(angle)};
}

kernels::ConicalFace<double> conical_face(double r_low, double r_high, double length) {
  const double rise = r_high - r_low, slant = std::hypot(rise, length);
  const double cosine = length / slant;
  return {cosine * r_low, rise / slant, cosine};
}

void require(bool condition, const std::string& solid_name, const char* what) {
  if (!condition) throw GeometryError("solid '" + solid_name + "': " + what);
}

void require_shape(const Solid& operand, const std::string& solid_name) {
  require(operand.shape != nullptr, solid_name,
          "it is made of an empty Solid{}, which has no shape");
}

void require_finite(std::initializer_list<double> values, const std::string& solid_name) {
  for (const double value : values) {
    require(std::isfinite(value), solid_name, "a dimension is not a finite number");
  }
}

kernels::Wedge<double> make_wedge(double start, double delta, const std::string& solid_name) {
  require_finite({start, delta}, solid_name);
  require(std::abs(start) < 1e6, solid_name, "the start angle is out of range");
  require(delta > 0, solid_name, "the angle spanned must be positive");
  if (delta >= 2 * std::numbers::pi - 1e-9) return {0, 1, 0, 1, 0};
  const UnitVector a = unit_vector(start), b = unit_vector(start + delta);
  const bool convex = delta <= std::numbers::pi * (1 + 1e-15);
  return {convex ? 1 : 2, a.x, a.y, b.x, b.y};
}

Extent sector_extent(double rmin, double rmax, double start, double delta, double zmin,
                     double zmax) {
  Extent e{{-rmax, -rmax, zmin}, {rmax, rmax, zmax}};
  if (delta >= 2 * std::numbers::pi - 1e-9) return e;
  e.min.x = e.min.y = INFINITY;
  e.max.x = e.max.y = -INFINITY;
  const auto add = [&](double r, UnitVector u) {
    e.min.x = std::min(e.min.x, r * u.x);
    e.max.x = std::max(e.max.x, r * u.x);
    e.min.y = std::min(e.min.y, r * u.y);
    e.max.y = std::max(e.max.y, r * u.y);
  };
  for (const double r : {rmin, rmax}) {
    add(r, unit_vector(start));
    add(r, unit_vector(start + delta));
    const double quarter = std::numbers::pi / 2;
    for (double k = std::ceil(start / quarter); k * quarter <= start + delta; ++k) {
      add(r, unit_vector(k * quarter));
    }
  }
  return e;
}

double angle_of(const kernels::Wedge<double>& w) {
  if (w.kind == 0) return 2 * std::numbers::pi;
  const double angle = std::atan2(w.start_x * w.end_y - w.start_y * w.end_x,
                                  w.start_x * w.end_x + w.start_y * w.end_y);
  return angle > 0 ? angle : angle + 2 * std::numbers::pi;
}

double squared_radius_integral(const kernels::ConicalFace<double>& f, double from, double to) {
  const double r1 = (f.radius + f.slope * from) / f.cosine;
  const double r2 = (f.radius + f.slope * to) / f.cosine;
  return (to - from) * (r1 * r1 + r1 * r2 + r2 * r2) / 3;
}

double radius_at(const kernels::ConicalFace<double>& face, double z, double flat) {
  return face.cosine > 1e-3 ? (face.radius + face.slope * z) / face.cosine : flat;
}

}  // namespace navjit::detail
