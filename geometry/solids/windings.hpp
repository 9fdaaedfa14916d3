// How often a polygon surrounds each part of the plane. Private to geometry/solids.
#pragma once

#include <vector>

#include "geometry/solids/solid.hpp"

namespace navjit::detail {

/// The area, mm^2, that an anticlockwise polygon surrounds more than once, or the wrong way round:
/// 0 if it does not cross itself. Infinity if it does so more than a thousand times.
double wrongly_surrounded(const std::vector<PlanarPoint>& polygon);

}  // namespace navjit::detail
