// Bodies of planes or of triangles, and upright prisms. Private to geometry/.
#pragma once

#include <span>
#include <vector>

#include "geometry/solids/make.hpp"

namespace navjit::detail {

/// The convex body behind planes with unit normals, which must enclose it.
Solid make_hull(std::string name, std::vector<kernels::Plane<double>> planes, const Extent& extent);

/// The upright prism over a polygon. Its corners are anticlockwise; none is on a line with its
/// neighbours, and no edge crosses another. The corners' own z do not matter.
Solid make_prism(std::string name, std::span<const Vec3> corners, double z_low, double z_high);

/// The plane through three points, with its normal towards the side from which they run
/// anticlockwise; all zero if they are on a line.
kernels::Plane<double> plane_through(const Vec3& a, const Vec3& b, const Vec3& c);

/// The body that these triangles bound; if they face inwards, all are turned over. Triangles
/// that do not close (each edge of one against one edge of another) are closed by
/// close_facets(); then `note`, unless null, is set to what was done. Throws GeometryError if
/// they enclose nothing.
Solid make_facets(std::string name, std::vector<Vec3> corners, std::vector<kernels::Facet> facets,
                  std::string* note);

}  // namespace navjit::detail
