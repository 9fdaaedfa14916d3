#include "geometry/solids/kernel_use.hpp"

#include <algorithm>
#include <cmath>

namespace navjit::face_error {
namespace {

/// Directions that count as along a face (kernels::along_a_face) drift away from it.
double drift(double path) { return 0x1p-50 * path; }

/// The error of a radius, from that of the squared radius, which is square * r^2 + cross * r *
/// reach + far * reach^2.
double round(double r, double reach, double square, double cross, double far) {
  if (r <= 0) return 0;
  const double squared = square * r * r + cross * r * reach + far * reach * reach;
  return std::min(squared / r, std::sqrt(squared));
}

}  // namespace

// The path is (h - p) * (1 / v): three roundings.
double slab(double offset, const KernelUse& use) {
  return rounding(3) * (use.reach + offset) + drift(use.path);
}

// The distance is n.p + d with four roundings; the rate has three, and the quotient one.
double plane(double offset, const KernelUse& use) {
  return rounding(5) * (use.reach + std::abs(offset)) + rounding(3) * use.path + drift(use.path);
}

// The discriminant comes from the moment of the ray, and the root from the discriminant.
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

}  // namespace navjit::face_error
