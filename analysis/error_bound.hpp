// How far off a step may be: bounds from rounding analysis, not estimates. docs/accuracy.md derives
// them.
#pragma once

#include <string>
#include <vector>

#include "geometry/navigation/geometry.hpp"

namespace navjit {

/// Of the steps made in a volume, by the generic navigator and by any of level `exact`: how far
/// from the surface of the exact detector that ends it a step may end, measured across the surface,
/// mm. For starts in the volume, directions of unit length to 1e-5 and anything that the file
/// places.
struct ErrorBound {
  double tolerance = 0;  ///< what counts as on a face (docs/tolerance.md)
  double frame = 0;      ///< frames composed and applied, directions turned
  double kernel = 0;     ///< distances to the surfaces
  /// Where no bound is known: of which solid. The parts that are known are given all the same.
  std::string unknown{};

  bool known() const { return unknown.empty(); }
  /// Infinity where it is not known.
  double total() const;
  bool operator==(const ErrorBound&) const = default;
};

/// By volume; those outside the tree get no bound.
std::vector<ErrorBound> error_bounds(const World& world);

}  // namespace navjit
