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

/// Up to `count` points on the solid's surface: where it is crossed by a few lines along the axes
/// and by random straight lines through its extent (so nearly uniform over the surface of convex
/// solids, unless most lines miss them, so thin are they). Between every two is a point of the
/// interior. Deterministic for a seed; fewer points, or none, if the solid is hard to hit.
SolidPoints sample_points(const Solid& solid, std::size_t count, double tolerance,
                          std::uint64_t seed);
/// Points that lines seldom find: the corners of the solid's box, the middles of its edges and
/// faces, as far as they are in the solid. A corner is often all that sticks out.
std::vector<Vec3> corner_points(const Solid& solid, double tolerance);
/// Points on the axes of the solid's frame, within its box, that are not in the solid: those of a
/// bore, however narrow it is.
std::vector<Vec3> bore_points(const Solid& solid, double tolerance);
/// The points on the surface alone.
std::vector<Vec3> surface_points(const Solid& solid, std::size_t count, double tolerance,
                                 std::uint64_t seed);

}  // namespace navjit
