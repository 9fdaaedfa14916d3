// Surface normals of any solid.
#pragma once

#include "geometry/solids/solid.hpp"

namespace navjit {

/// The outward unit normal of the solid at a point p (mm, the solid's own frame) on its surface;
/// near it, that of the face it is nearest to. `tolerance` (mm) is how far off the surface the
/// point may be and how near to an edge it counts as on it: there, the first of the faces in the
/// solid's own order is taken (docs/normals.md). Threads may call it at will; it throws nothing.
Vec3 normal(const kernels::AnySolid<double>& solid, const Vec3& p, double tolerance);

}  // namespace navjit
