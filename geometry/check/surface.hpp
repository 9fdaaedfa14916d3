// Points on the surface of any solid.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/solids/solid.hpp"

namespace navjit {

/// Up to `count` points on the solid's surface, in its own frame: where random straight lines
/// through its extent cross it (so uniform over the surface for convex solids). Deterministic for a
/// seed; fewer than asked if the solid is hard to hit.
std::vector<Vec3> surface_points(const Solid& solid, std::size_t count, double tolerance,
                                 std::uint64_t seed);

}  // namespace navjit
