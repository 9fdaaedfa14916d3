// The parts of straight lines within a solid.
#pragma once

#include <vector>

#include "geometry/solids/solid.hpp"

namespace navjit {

/// A part of a line within a solid: paths from the line's start, mm.
struct Chord {
  double enter, leave;
};

/// The parts within the solid of the line from p along the unit vector v, up to the path `reach`,
/// in order; at most 32. The start has to be outside of the solid.
std::vector<Chord> chords_along(const kernels::AnySolid<double>& solid, const Vec3& p,
                                const Vec3& v, double reach, double tolerance);

}  // namespace navjit
