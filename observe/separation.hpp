// Tells whether a solid is within another, and whether two are apart. This is proved if their boxes
// or radii tell, and sampled if they do not.
#pragma once

#include <cstdint>
#include <map>

#include "geometry/check/aimed.hpp"
#include "geometry/check/surface.hpp"

namespace navjit {

/// How sure it is that solids do not touch what they must not. In doubt the answer is `no`.
enum class Certainty : std::uint8_t { no, sampled, proved };

inline Certainty weaker(Certainty a, Certainty b) { return a < b ? a : b; }

/// Answers for the solids of one mother, and keeps the points of solids that were sampled. Solids
/// that reach into or out of each other by no more than the tolerance (mm) count as not doing so.
class Separation {
 public:
  Separation(double tolerance, double rounding) : tolerance_(tolerance), rounding_(rounding) {}

  /// Whether `inner` is within `outer`, in whose frame it is placed.
  Certainty within(const PlacedSolid& inner, const Solid& outer);
  /// Whether two solids that are placed in the same frame have no point in common.
  Certainty apart(const PlacedSolid& a, const PlacedSolid& b);

 private:
  const SolidPoints& points_of(const Solid& solid);
  bool holds_hole_of(const PlacedSolid& inner, const Solid& outer);
  bool reaches_into(const PlacedSolid& a, const PlacedSolid& b);

  double tolerance_;
  double rounding_;  ///< how near to a face a point counts as on the face, mm
  std::map<const void*, SolidPoints> points_;
};

}  // namespace navjit
