// How far off a step may be: bounds from rounding analysis, not estimates. docs/accuracy.md derives
// them.
#pragma once

#include <string>
#include <vector>

#include "geometry/navigation/geometry.hpp"

namespace navjit {

/// How far from the surface of the exact detector that ends it a step made in a volume may end,
/// measured across the surface, mm. Holds for all navigators, for starts in the volume, directions
/// of unit length to 1e-5 and anything that the file places.
struct ErrorBound {
  double tolerance = 0;  ///< what counts as on a face (docs/tolerance.md)
  double frame = 0;      ///< frames composed and applied, directions turned
  double kernel = 0;     ///< distances to the surfaces
  /// The kind of solid for which no bound is known; empty if there is none. The parts that are
  /// known are given all the same.
  std::string unknown{};

  bool known() const { return unknown.empty(); }
  /// Infinity where it is not known.
  double total() const;
  bool operator==(const ErrorBound&) const = default;
};

/// By volume; those outside the tree get no bound.
std::vector<ErrorBound> error_bounds(const World& world);

}  // namespace navjit
