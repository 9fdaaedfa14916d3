// The box around a box that was moved.
#pragma once

#include "geometry/solids/solid.hpp"

namespace navjit {

/// The smallest box along the outer axes around a box of the inner frame, mm. `translation` and
/// `rotation` are those of a Transformation.
Extent moved_box(const Extent& box, const double (&translation)[3], const double (&rotation)[9]);

}  // namespace navjit
