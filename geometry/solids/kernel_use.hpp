// Rounding in kernels: how far from its true place a face may be found. The bounds of solids
// (SolidFacts::error) are made of these.
#pragma once

#include "geometry/solids/parts.hpp"

namespace navjit {

/// Half the distance from 1 to the next double.
inline constexpr double unit_roundoff = 0x1p-53;
/// n roundings in a row: the gamma_n of Higham, Accuracy and Stability of Numerical Algorithms
/// (2nd ed., SIAM 2002), lemma 3.1.
constexpr double rounding(int n) { return n * unit_roundoff / (1 - n * unit_roundoff); }

/// For which lengths a bound holds, mm.
struct KernelUse {
  double reach;      ///< how far starts may be from the solid's origin
  double path;       ///< how long paths may be
  double tolerance;  ///< that of the world
};

namespace face_error {

/// A face across an axis at `offset` from the origin.
double slab(double offset, const KernelUse& use);
/// Any plane at `offset` from the origin.
double plane(double offset, const KernelUse& use);
/// An infinite cylinder.
double cylinder(double r, const KernelUse& use);
double ball(double r, const KernelUse& use);
double wedge(const kernels::Wedge<double>& w, const KernelUse& use);

}  // namespace face_error
}  // namespace navjit
