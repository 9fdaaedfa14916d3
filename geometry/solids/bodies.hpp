// Bodies of planes, of triangles and upright prisms. Private to geometry/.
#pragma once

#include <span>
#include <vector>

#include "geometry/solids/make.hpp"

namespace navjit::detail {

/// The convex body behind planes with unit normals, which must enclose it.
Solid make_hull(std::string name, std::vector<kernels::Plane<double>> planes, const Extent& extent);

/// The upright prism over a polygon: its corners anticlockwise, none on a line with its neighbours,
/// no edge crossing another. The corners' own z do not matter.
Solid make_prism(std::string name, std::span<const Vec3> corners, double z_low, double z_high);

/// The plane through three points, with its normal towards the side from which they run
/// anticlockwise; all zero if they are on a line.
kernels::Plane<double> plane_through(const Vec3& a, const Vec3& b, const Vec3& c);

/// The body that these triangles bound: all turned over if they face inwards. Those that do not
/// close on one another, one edge of one against one edge of another, are closed as close_facets
/// does it; `note`, unless null, is then set to what was done. Throws GeometryError if they enclose
/// nothing.
Solid make_facets(std::string name, std::vector<Vec3> corners, std::vector<kernels::Facet> facets,
                  std::string* note);

}  // namespace navjit::detail
