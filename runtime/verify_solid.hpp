// Verifies code that was compiled for a solid against the solid's own kernels, before it is used.
#pragma once

#include <string>

#include "codegen/data/quick_solid.hpp"
#include "geometry/solids/solid.hpp"

namespace navjit {

/// Compares all answers, bit for bit, on `points` made-up points in and around the box `extent`,
/// and at the points where the rays from them meet the solid. Returns an empty string, or a
/// description of the first answer that differs.
std::string verify_solid(const kernels::AnySolid<double>& solid, const kernels::SolidCode& code,
                         const Extent& extent, double tolerance, int points, std::uint64_t seed);

}  // namespace navjit
