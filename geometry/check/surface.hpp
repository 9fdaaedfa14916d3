// Points on the surface of any solid, and within it.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/solids/solid.hpp"

namespace navjit {

/// Points of one solid in its own frame, mm.
struct SolidPoints {
  std::vector<Vec3> surface;
  std::vector<Vec3>
      interior;  ///< the middles of chords: in the solid, or on a face where it is thin
};

/// Up to `count` points on the solid's surface: where a few lines along the axes and random
/// straight lines through its extent cross it (so nearly uniform over the surface for convex
/// solids, unless they are so thin that most lines miss them). Between every two is a point of the
/// interior. Deterministic for a seed; fewer than asked, or none, if the solid is hard to hit.
SolidPoints sample_points(const Solid& solid, std::size_t count, double tolerance,
                          std::uint64_t seed);
/// Those on the surface alone.
std::vector<Vec3> surface_points(const Solid& solid, std::size_t count, double tolerance,
                                 std::uint64_t seed);

}  // namespace navjit
