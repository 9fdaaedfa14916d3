// Is a solid within another, are two apart? Proved where their boxes or radii say so, sampled where
// they do not.
#pragma once

#include <cstdint>
#include <map>

#include "geometry/check/aimed.hpp"
#include "geometry/check/surface.hpp"

namespace navjit {

/// Where there is a doubt the answer is `no`.
enum class Verdict : std::uint8_t { no, sampled, proved };

inline Verdict weaker(Verdict a, Verdict b) { return a < b ? a : b; }

/// Answers for solids of one mother; keeps the points of solids that it sampled. Solids that reach
/// into each other, or out of each other, by no more than the tolerance (mm) count as not doing so.
class Separation {
 public:
  Separation(double tolerance, double rounding) : tolerance_(tolerance), rounding_(rounding) {}

  /// Whether the solid is within the other, in whose frame it is placed.
  Verdict within(const PlacedSolid& inner, const Solid& outer);
  /// Whether two solids, placed in the same frame, share nothing.
  Verdict apart(const PlacedSolid& a, const PlacedSolid& b);

 private:
  const SolidPoints& points_of(const Solid& solid);
  bool holds_hole_of(const PlacedSolid& inner, const Solid& outer);
  bool reaches_into(const PlacedSolid& a, const PlacedSolid& b);

  double tolerance_;
  double rounding_;  ///< how near to a face a point counts as on it, mm
  std::map<const void*, SolidPoints> points_;
};

}  // namespace navjit
