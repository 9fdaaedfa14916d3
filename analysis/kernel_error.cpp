#include "analysis/kernel_error.hpp"

#include <algorithm>
#include <cmath>

namespace navjit {
namespace {

const double root3 = std::sqrt(3.0);

struct ErrorOf {
  const KernelUse& use;
  using Bound = std::optional<double>;

  /// The bound in SolidFacts; nothing if none is derived.
  template <class Shape>
  Bound operator()(const Shape& s) const {
    if constexpr (requires { SolidFacts<Shape>::error(s, use); }) {
      return SolidFacts<Shape>::error(s, use);
    }
    return std::nullopt;
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

  /// The bound of a crossing of an operand's surface, seen from a point on the ray that is computed
  /// from the start. Containment decides in which operand the ray is, and allows for the tolerance.
  /// So the tolerance has to exceed all rounding.
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
