// How far off a step may be. These are bounds from rounding analysis, not estimates;
// docs/accuracy.md derives them.
#pragma once

#include <string>
#include <vector>

#include "geometry/navigation/geometry.hpp"

namespace navjit {

/// For a step that is made in a volume: how far its end may be from the surface of the exact
/// detector at which the step ends, measured across the surface, mm. Holds for all navigators, for
/// starts in the volume, for directions of unit length to 1e-5, and for all placements in the file.
struct ErrorBound {
  double tolerance = 0;  ///< the distance at which a point counts as on a face (docs/tolerance.md)
  double frame = 0;      ///< from composing and applying frames, and from rotating directions
  double kernel = 0;     ///< from the distances to the surfaces
  /// The kind of solid for which no bound is known; empty if there is none. The known parts are
  /// given in any case.
  std::string unknown{};

  bool known() const { return unknown.empty(); }
  /// Infinity if no bound is known.
  double total() const;
  bool operator==(const ErrorBound&) const = default;
};

/// By volume. Volumes outside the tree get no bound.
std::vector<ErrorBound> error_bounds(const World& world);

}  // namespace navjit
