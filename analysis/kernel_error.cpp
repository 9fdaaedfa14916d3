#include "analysis/kernel_error.hpp"

#include <algorithm>
#include <cmath>

namespace navjit {
namespace {

const double root3 = std::sqrt(3.0);

/// Directions that count as along a face (kernels::along_a_face) drift off it.
double drift(double path) { return 0x1p-50 * path; }

/// A face across an axis, `offset` from the origin: (h - p) * (1 / v), three roundings.
double slab(double offset, const KernelUse& use) {
  return rounding(3) * (use.reach + offset) + drift(use.path);
}

/// A plane n.p + d: four roundings of the distance, three of the rate, one of the quotient.
double plane(double offset, const KernelUse& use) {
  return rounding(5) * (use.reach + std::abs(offset)) + rounding(3) * use.path + drift(use.path);
}
double plane(const kernels::Plane<double>& f, const KernelUse& use) { return plane(f.d, use); }

/// From the error of a squared radius, square * r^2 + cross * r * reach + far * reach^2, that of
/// the radius.
double round(double r, double reach, double square, double cross, double far) {
  if (r <= 0) return 0;
  const double squared = square * r * r + cross * r * reach + far * reach * reach;
  return std::min(squared / r, std::sqrt(squared));
}

/// An infinite cylinder: the discriminant from the moment of the ray, the root from it.
double cylinder(double r, const KernelUse& use) {
  return round(r, use.reach, rounding(24), rounding(20), 100 * rounding(1) * rounding(1)) +
         2 * drift(use.path);
}
double ball(double r, const KernelUse& use) {
  return round(r, use.reach, rounding(30), rounding(25), 160 * rounding(1) * rounding(1));
}
double wedge(const kernels::Wedge<double>& w, const KernelUse& use) {
  return w.kind == 0 ? 0 : plane(0, use);
}

struct ErrorOf {
  const KernelUse& use;
  using Bound = std::optional<double>;

  /// All that no bound is derived for.
  template <class Shape>
  Bound operator()(const Shape&) const {
    return std::nullopt;
  }
  Bound operator()(const kernels::Box<double>& s) const {
    return slab(std::max({s.hx, s.hy, s.hz}), use);
  }
  Bound operator()(const kernels::Trd<double>& s) const {
    return std::max({slab(s.hz, use), plane(s.x.offset, use), plane(s.y.offset, use)});
  }
  Bound operator()(const kernels::Trap<double>& s) const {
    return std::max({slab(s.hz, use), plane(s.x_minus, use), plane(s.x_plus, use),
                     plane(s.y_minus, use), plane(s.y_plus, use)});
  }
  Bound operator()(const kernels::Hull<double>& s) const {
    double error = 0;
    for (int i = 0; i < s.count; ++i) error = std::max(error, plane(s.planes[i], use));
    return error;
  }
  Bound operator()(const kernels::Tube<double>& s) const {
    return std::max(
        {slab(s.hz, use), cylinder(s.rmax, use), cylinder(s.rmin, use), wedge(s.wedge, use)});
  }
  Bound operator()(const kernels::Orb<double>& s) const { return ball(s.radius, use); }
  Bound operator()(const kernels::Sphere<double>& s) const {
    if (s.low.kind != 0 || s.high.kind != 0) return std::nullopt;
    return std::max({ball(s.rmax, use), ball(s.rmin, use), wedge(s.wedge, use)});
  }

  Bound operator()(const kernels::AnyPlaced<double>& s) const {
    const double skew = s.rotated == 0 ? 0 : skew_of(s.rotation);
    const double from =
        (1 + skew) * (use.reach + std::hypot(s.translation[0], s.translation[1], s.translation[2]));
    const Bound inner = kernel_error(s.solid, {from, (1 + skew) * use.path, use.tolerance});
    if (!inner) return std::nullopt;
    const double applied = s.rotated == 0
                               ? rounding(1) * from
                               : root3 * (1 + skew) * (rounding(4) * from + rounding(3) * use.path);
    return (1 + skew) * (*inner + applied);
  }

  /// A crossing of an operand's surface, seen from a point on the ray that is computed from the
  /// start. From which operand to which is told by containment, which forgives the tolerance: that
  /// has to be more than any rounding.
  template <class Boolean>
  Bound boolean(const Boolean& s) const {
    const KernelUse along{use.reach + use.path, use.path, use.tolerance};
    const Bound a = kernel_error(s.a.solid, along), b = kernel_error(s.b.solid, along);
    if (!a || !b) return std::nullopt;
    const double error = std::max(*a, *b) + rounding(3) * (use.reach + use.path);
    if (2 * error > use.tolerance) return std::nullopt;
    return error;
  }
  Bound operator()(const kernels::AnyUnion<double>& s) const { return boolean(s); }
  Bound operator()(const kernels::AnyIntersection<double>& s) const { return boolean(s); }
  Bound operator()(const kernels::AnySubtraction<double>& s) const { return boolean(s); }
};

}  // namespace

double skew_of(const double (&rotation)[9]) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      long double product = i == j ? -1 : 0;
      for (int k = 0; k < 3; ++k) {
        product += static_cast<long double>(rotation[3 * i + k]) * rotation[3 * j + k];
      }
      sum += static_cast<double>(product * product);
    }
  }
  return std::sqrt(sum) * (1 + 1e-6) + 1e-17;
}

std::optional<double> kernel_error(const kernels::AnySolid<double>& solid, const KernelUse& use) {
  return kernels::visit(solid, ErrorOf{use});
}

}  // namespace navjit
