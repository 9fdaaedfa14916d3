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

/// A bound of the distance from the solid's surface to the point that distance_to_in or
/// distance_to_out tells, mm, for starts up to `reach` mm from the solid's origin and paths up to
/// `path` mm, all in the solid's frame and taken as exact there. Tolerances come on top. Nothing
/// for solids that no bound is derived for.
std::optional<double> kernel_error(const Solid& solid, double reach, double path);

}  // namespace navjit
