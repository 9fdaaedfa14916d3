// How far from its surface a solid's kernel may see a crossing.
#pragma once

#include <optional>

#include "geometry/solids/solid.hpp"

namespace navjit {

/// Half the distance from 1 to the next double.
inline constexpr double unit_roundoff = 0x1p-53;
/// n roundings in a row: the gamma_n of Higham, Accuracy and Stability of Numerical Algorithms
/// (2nd ed., SIAM 2002), lemma 3.1.
constexpr double rounding(int n) { return n * unit_roundoff / (1 - n * unit_roundoff); }

/// The norm of r r' - 1 for a rotation by rows, and what computing it may have hidden.
double skew_of(const double (&rotation)[9]);

/// What a bound holds for, mm.
struct KernelUse {
  double reach;      ///< how far starts may be from the solid's origin
  double path;       ///< how long paths may be
  double tolerance;  ///< of the world
};

/// A bound of the distance from the solid's surface to the point that distance_to_in or
/// distance_to_out tells, mm, with point and direction in the solid's frame taken as exact.
/// Tolerances come on top. Nothing for solids that no bound is derived for.
std::optional<double> kernel_error(const kernels::AnySolid<double>& solid, const KernelUse& use);

}  // namespace navjit
