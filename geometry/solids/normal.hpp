// Surface normals of solids of any kind.
#pragma once

#include "geometry/solids/solid.hpp"

namespace navjit {

/// The outward unit normal of the solid at a point p (mm, in the solid's own frame) on its surface;
/// near the surface, that of the nearest face. `tolerance` (mm) is how far from the surface the
/// point may be, and how near to an edge it counts as on the edge: there the first of the faces in
/// the solid's own order is taken (docs/normals.md). Thread-safe; it throws nothing.
Vec3 normal(const kernels::AnySolid<double>& solid, const Vec3& p, double tolerance);

}  // namespace navjit
