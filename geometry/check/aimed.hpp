// Whether two solids hold the same points, by lines that are aimed at where their boxes meet.
#pragma once

#include <cstdint>
#include <optional>

#include "geometry/model/transformation.hpp"

namespace navjit {

/// A solid with its frame in the mother.
struct PlacedSolid {
  const Solid& solid;
  const Transformation& transformation;
};

/// A point in the mother's frame that two solids share.
struct SharedPoint {
  Vec3 point;
  double depth;  ///< a lower bound of how far they would have to be moved apart, mm
};

/// Whether two solids can share a part thicker than the tolerance at all. They cannot if their
/// boxes, each in its own frame, are apart.
bool boxes_meet(const PlacedSolid& a, const PlacedSolid& b, double tolerance);

/// A point of the solid that is outside of `outer`, in whose frame it is placed, found on `lines`
/// random lines through the solid's box: parts of its chords that are no part of a chord of
/// `outer`. It finds holes that the solid covers where no point of its surface is. `depth` is how
/// far the point is from both surfaces together.
std::optional<SharedPoint> find_point_beyond(const PlacedSolid& solid, const Solid& outer,
                                             std::size_t lines, double tolerance, double rounding,
                                             std::uint64_t seed);

/// The deepest shared point that is found on `lines` lines through the part of each solid's box
/// that lies in the other's. It finds what points on surfaces miss: solids that coincide, plates
/// and wires that cross. Nothing for solids that only touch, or that share less than the tolerance.
std::optional<SharedPoint> find_shared_point(const PlacedSolid& a, const PlacedSolid& b,
                                             std::size_t lines, double tolerance, double rounding,
                                             std::uint64_t seed);

}  // namespace navjit
