// Solids: shapes with a name.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "navjit/detail/api.hpp"
#include "navjit/errors.hpp"
#include "navjit/solid_kind.hpp"
#include "navjit/vector.hpp"

namespace NAVJIT_API navjit {

/// An immutable solid, made by one of the functions below. Copies share the shape.
struct Solid {
  std::string name;
  SolidKind kind = SolidKind::box;
  std::shared_ptr<const void> shape;  ///< the library's own; null where there is no solid
  Extent extent{};                    ///< contains the solid; tight for the primitives

  kernels::AnySolid<double> any() const;  ///< for the library's own parts
};

/// Mother-to-local of a solid within a boolean: local = rotation * (p - translation), in mm.
struct SolidFrame {
  double translation[3] = {0, 0, 0};
  double rotation[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
};

/// Lengths are mm, angles rad, h* are half lengths. All makers are thread-safe, and throw
/// GeometryError on dimensions that make no solid; the message says which. What equals a simpler
/// solid is made as that, for speed, and has its kind: a cone of one radius is a tube, a polycone
/// of two planes about z = 0 a cone, a trd with upright sides a box, a whole sphere an orb.
Solid make_box(std::string name, double hx, double hy, double hz);
Solid make_tube(std::string name, double rmin, double rmax, double hz, double start_phi,
                double delta_phi);
/// rmin1, rmax1 at -hz and rmin2, rmax2 at +hz. Either end may be a point or a circle.
Solid make_cone(std::string name, double rmin1, double rmax1, double rmin2, double rmax2, double hz,
                double start_phi, double delta_phi);
/// hx1, hy1 at -hz and hx2, hy2 at +hz. One of each pair may be zero.
Solid make_trd(std::string name, double hx1, double hx2, double hy1, double hy2, double hz);
/// theta, phi: direction of the line through the centres of the faces at -hz and +hz. At -hz: hy1,
/// hx1 at -hy1, hx2 at +hy1, and alpha1 the slant of the line through the middles of those edges;
/// at +hz likewise hy2, hx3, hx4, alpha2. Where a side is not planar, the
/// solid is the arb8 of the eight corners.
Solid make_trap(std::string name, double hz, double theta, double phi, double hy1, double hx1,
                double hx2, double alpha1, double hy2, double hx3, double hx4, double alpha2);
/// A trap whose opposite faces are equal: a section at any z has the half lengths hx and hy.
Solid make_para(std::string name, double hx, double hy, double hz, double alpha, double theta,
                double phi);
/// The tetrahedron of four corners.
Solid make_tet(std::string name, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// A point of a polygon, mm.
struct PlanarPoint {
  double x, y;
};
/// The polygon, scaled and then moved, at one z.
struct ExtrudedSection {
  double z, x, y, scale;
};
/// A polygon (either way round, convex or not) along sections that ascend in z. It may touch
/// itself. It may cross itself if the area that it then surrounds the wrong way round, or more than
/// once, is at most 1e-4 of its own: the solid is what it surrounds at least once the right way
/// round, and `note`, unless null, is set to what was done.
Solid make_extruded(std::string name, std::span<const PlanarPoint> polygon,
                    std::span<const ExtrudedSection> sections, std::string* note = nullptr);

/// Three or four corners, anticlockwise seen from outside. A facet of four is cut in two from its
/// first corner to its third.
using FacetCorners = std::vector<Vec3>;
/// The body within the facets. Where they do not close on one another, doubled ones are left out,
/// single ones are turned, and what is still open is spanned by triangles; `note`, unless null, is
/// set to what was done.
Solid make_tessellated(std::string name, std::span<const FacetCorners> facets,
                       std::string* note = nullptr);

/// Four corners at -hz, then, the same way round, four at +hz, joined by straight lines: the sides
/// may twist by up to a right angle. Corners may coincide.
Solid make_arb8(std::string name, double hz, std::span<const PlanarPoint, 8> corners);

/// A tube cut off at (0, 0, -hz) across `low` and at (0, 0, hz) across `high`, the outward normals.
Solid make_cut_tube(std::string name, double rmin, double rmax, double hz, double start_phi,
                    double delta_phi, const Vec3& low, const Vec3& high);

/// A corner of a contour about the z axis: radius and height, mm.
struct ContourPoint {
  double r, z;
};
/// The closed contour of a polycone: either way round, not crossing itself.
Solid make_generic_polycone(std::string name, std::span<const ContourPoint> contour,
                            double start_phi, double delta_phi);
/// Likewise; here the radii are those of the edges between the sides.
Solid make_generic_polyhedra(std::string name, std::span<const ContourPoint> contour, int sides,
                             double start_phi, double delta_phi);

/// The solid with its coordinates multiplied by the factors, which may be negative but not zero.
Solid make_scaled(std::string name, const Solid& solid, double x, double y, double z);
/// A whole ball.
Solid make_orb(std::string name, double radius);
/// theta is measured from +z. A whole ball becomes an orb.
Solid make_sphere(std::string name, double rmin, double rmax, double start_phi, double delta_phi,
                  double start_theta, double delta_theta);

/// The radii of a polycone or polyhedra at one z.
struct ZPlane {
  double z, rmin, rmax;
  friend bool operator==(const ZPlane&, const ZPlane&) = default;
};
/// The contour runs along the planes' rmax and back along their rmin; it may step (equal z) and
/// turn back, but not cross itself.
Solid make_polycone(std::string name, std::span<const ZPlane> planes, double start_phi,
                    double delta_phi);
/// `sides` flat sides spread evenly over delta_phi, with an edge at start_phi; radii are the
/// distances of the sides from the axis.
Solid make_polyhedra(std::string name, std::span<const ZPlane> planes, int sides, double start_phi,
                     double delta_phi);

/// The points at rmin..rmax from a circle of radius rtor in the plane z = 0; with rmax >= rtor they
/// reach the axis.
Solid make_torus(std::string name, double rmin, double rmax, double rtor, double start_phi,
                 double delta_phi);
/// Cut to z from z_cut1 to z_cut2, unless both are 0.
Solid make_ellipsoid(std::string name, double ax, double by, double cz, double z_cut1,
                     double z_cut2);
/// A tube whose section is the ellipse of half axes hx and hy.
Solid make_eltube(std::string name, double hx, double hy, double hz);
/// Half lengths x_slope * (z_max - z) and y_slope * (z_max - z) for |z| <= z_cut; a z_cut above
/// z_max counts as z_max.
Solid make_elcone(std::string name, double x_slope, double y_slope, double z_max, double z_cut);
/// The squared radius is linear in z, from r_low at -hz to r_high at +hz.
Solid make_paraboloid(std::string name, double r_low, double r_high, double hz);
/// Squared radius at z: that at 0 plus the square of z times the tangent of the stereo angle.
Solid make_hype(std::string name, double rmin, double rmax, double inner_stereo,
                double outer_stereo, double hz);

/// A tube segment whose lines along z are inclined, so that they rule hyperboloids: radii from rmin
/// to rmax and azimuth from -phi/2 to phi/2 at z = 0; at the end of larger |z| the section is
/// turned by half of `twist`.
Solid make_twistedtubs(std::string name, double twist, double rmin, double rmax, double z_low,
                       double z_high, double phi);
/// A box turned by `twist` in all from -hz to +hz, in proportion to z.
Solid make_twistedbox(std::string name, double twist, double hx, double hy, double hz);
Solid make_twistedtrd(std::string name, double hx1, double hx2, double hy1, double hy2, double hz,
                      double twist);
/// The dimensions are those of a trap whose sections are turned about their middles. Dimensions of
/// sections are linear in z, also where the untwisted sides would not be planar.
Solid make_twistedtrap(std::string name, double twist, double hz, double theta, double phi,
                       double hy1, double hx1, double hx2, double hy2, double hx3, double hx4,
                       double alpha);

/// A solid moved and turned, and the booleans of two: the points in either, in both, or in `a` and
/// not in `b`. Move the second operand by make_placed. They throw GeometryError as all makers do.
Solid make_placed(std::string name, const Solid& solid, const SolidFrame& frame);
Solid make_union(std::string name, const Solid& a, const Solid& b);
Solid make_intersection(std::string name, const Solid& a, const Solid& b);
Solid make_subtraction(std::string name, const Solid& a, const Solid& b);

/// Volume, mm^3, in closed form; not a number if a boolean is involved. Thread-safe. Throws
/// GeometryError for an empty Solid{}.
double capacity(const Solid& solid);

/// The lower-case name used in output: "box", "subtraction", ...
const char* kind_name(SolidKind kind);

}  // namespace navjit
