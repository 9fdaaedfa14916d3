// How far from the surface of a solid its kernel may find a crossing.
#pragma once

#include <optional>

#include "geometry/solids/kernel_use.hpp"
#include "geometry/solids/solid.hpp"

namespace navjit {

/// The norm of r r' - 1 for a rotation r that is given by rows, plus a bound of what rounding may
/// hide of it.
double skew_of(const double (&rotation)[9]);

/// A bound of the distance from the solid's surface to the point that distance_to_in or
/// distance_to_out finds, mm, where point and direction in the solid's frame count as exact.
/// Tolerances are not included. Nothing for solids for which no bound is derived.
std::optional<double> kernel_error(const kernels::AnySolid<double>& solid, const KernelUse& use);

}  // namespace navjit
