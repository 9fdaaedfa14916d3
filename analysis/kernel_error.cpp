#include "analysis/kernel_error.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/solids/extent.hpp"

namespace navjit {
namespace {

using std::max;

/// Directions that count as along a face (kernels::along_a_face) drift off it.
double drift(double path) { return 0x1p-50 * path; }

/// A face along two axes: (h - p) * (1 / v), three roundings.
double slab(double reach, double size, double path) {
  return rounding(3) * (reach + size) + drift(path);
}

/// A plane n.p + d: four roundings of the distance, three of the rate, one of the quotient.
double plane(double reach, double size, double path) {
  return rounding(5) * (reach + size) + rounding(3) * path + drift(path);
}

/// From the error of a squared radius, square * r^2 + cross * r * reach + far * reach^2, that of the
/// radius.
double round(double r, double reach, double square, double cross, double far) {
  if (r <= 0) return 0;
  const double squared = square * r * r + cross * r * reach + far * reach * reach;
  return std::min(squared / r, std::sqrt(squared));
}

/// An infinite cylinder: the discriminant from the moment of the ray, the root from it.
double cylinder(double r, double reach, double path) {
  return round(r, reach, rounding(24), rounding(20), 100 * rounding(1) * rounding(1)) +
         2 * drift(path);
}

double ball(double r, double reach) {
  return round(r, reach, rounding(30), rounding(25), 160 * rounding(1) * rounding(1));
}

double wedge(const kernels::Wedge<double>& w, double reach, double size, double path) {
  return w.kind == 0 ? 0 : plane(reach, size, path);
}

}  // namespace

std::optional<double> kernel_error(const Solid& solid, double reach, double path) {
  const double size = std::sqrt(3.0) * largest_coordinate(solid.extent);
  const double flat = slab(reach, size, path);
  const auto shape = [&]<class Shape>(const Shape*) -> const Shape& {
    return *static_cast<const Shape*>(solid.shape.get());
  };
  switch (solid.kind) {
    case SolidKind::box:
      return flat;
    case SolidKind::trd:
    case SolidKind::trap:
    case SolidKind::hull:
      return max(flat, plane(reach, size, path));
    case SolidKind::tube: {
      const auto& s = shape(static_cast<const kernels::Tube<double>*>(nullptr));
      return max({flat, cylinder(s.rmax, reach, path), cylinder(s.rmin, reach, path),
                  wedge(s.wedge, reach, size, path)});
    }
    case SolidKind::orb: {
      const auto& s = shape(static_cast<const kernels::Orb<double>*>(nullptr));
      return ball(s.radius, reach);
    }
    case SolidKind::sphere: {
      const auto& s = shape(static_cast<const kernels::Sphere<double>*>(nullptr));
      if (s.low.kind != 0 || s.high.kind != 0) return std::nullopt;
      return max({ball(s.rmax, reach), ball(s.rmin, reach), wedge(s.wedge, reach, size, path)});
    }
    default:
      return std::nullopt;
  }
}

}  // namespace navjit
