// Frames (navjit/transformation.hpp) for code that navigates.
//
// Directions get +0 added to each component, so that dropping terms cannot change the sign of a
// zero. See docs/numerics.md.
#pragma once

#include "geometry/solids/solid.hpp"
#include "navjit/transformation.hpp"

namespace navjit {

inline Direction to_local(const Transformation& t, const Direction& v) {
  if (!t.rotated) return v;
  const double* r = t.rotation;
  return kernels::make_direction(rotate_row(r, v.x, v.y, v.z), rotate_row(r + 3, v.x, v.y, v.z),
                                 rotate_row(r + 6, v.x, v.y, v.z));
}

}  // namespace navjit
