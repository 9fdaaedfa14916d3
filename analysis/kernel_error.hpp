// How far from its surface a solid's kernel may see a crossing.
#pragma once

#include <optional>

#include "geometry/solids/kernel_use.hpp"
#include "geometry/solids/solid.hpp"

namespace navjit {

/// The norm of r r' - 1 for a rotation by rows, with a bound of what rounding may have hidden of
/// it.
double skew_of(const double (&rotation)[9]);

/// A bound of the distance from the solid's surface to the point that distance_to_in or
/// distance_to_out tells, mm, with point and direction in the solid's frame taken as exact.
/// Tolerances come on top. Nothing for solids that no bound is derived for.
std::optional<double> kernel_error(const kernels::AnySolid<double>& solid, const KernelUse& use);

}  // namespace navjit
