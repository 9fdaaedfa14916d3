#include "observe/separation.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/model/placed_extent.hpp"
#include "navjit/errors.hpp"

namespace navjit {
namespace {

constexpr std::size_t surface_points_of_each = 400;
constexpr std::size_t lines_of_each_pair = 64, lines_through_each = 512;
constexpr std::uint64_t seed = 18;

bool holds(const Extent& outer, const Extent& inner, double tolerance) {
  return inner.min.x >= outer.min.x - tolerance && inner.max.x <= outer.max.x + tolerance &&
         inner.min.y >= outer.min.y - tolerance && inner.max.y <= outer.max.y + tolerance &&
         inner.min.z >= outer.min.z - tolerance && inner.max.z <= outer.max.z + tolerance;
}

const kernels::Tube<double>* tube_of(const Solid& solid) {
  return solid.kind == SolidKind::tube
             ? static_cast<const kernels::Tube<double>*>(solid.shape.get())
             : nullptr;
}

bool whole(const kernels::Wedge<double>& wedge) { return wedge.kind == 0; }

bool convex(const Solid& solid) {
  switch (solid.kind) {
    case SolidKind::box:
    case SolidKind::trd:
    case SolidKind::hull:
    case SolidKind::orb:
      return true;
    case SolidKind::tube:
      return tube_of(solid)->rmin == 0 && whole(tube_of(solid)->wedge);
    default:
      return false;
  }
}

/// The corners of a solid's box, in the frame that it is placed in.
template <class F>
void for_each_corner(const PlacedSolid& s, const F& f) {
  const Extent& e = s.solid.extent;
  for (int i = 0; i < 8; ++i) {
    f(to_outer(s.transformation,
               {(i & 1) != 0 ? e.max.x : e.min.x, (i & 2) != 0 ? e.max.y : e.min.y,
                (i & 4) != 0 ? e.max.z : e.min.z}));
  }
}

/// Is the solid on the other's z axis, and turned at most about this axis?
bool on_one_axis(const Transformation& t) {
  return t.translation[0] == 0 && t.translation[1] == 0 && std::abs(t.rotation[8]) == 1;
}

/// A frame between two solids of the same mother: from the frame of `a` into that of `b`.
Transformation between(const PlacedSolid& a, const PlacedSolid& b) {
  Transformation inverse;
  const Vec3 origin = to_local(a.transformation, Vec3{0, 0, 0});
  double translation[3] = {origin.x, origin.y, origin.z}, rotation[9];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rotation[3 * i + j] = a.transformation.rotation[3 * j + i];
  }
  inverse = make_transformation(translation, rotation);
  return compose(inverse, b.transformation);
}

/// A bound of the distance of a placed solid's points from the z axis of its frame.
double reach_across(const Solid& solid, const Transformation& t) {
  const auto* tube = tube_of(solid);
  if (tube != nullptr && on_one_axis(t)) return tube->rmax;
  double reach = 0;
  for_each_corner({solid, t},
                  [&](const Vec3& p) { reach = std::max(reach, std::hypot(p.x, p.y)); });
  return reach;
}

/// Is `inner` in the bore of `outer`? `t` places it in the frame of `outer`.
bool in_the_bore(const Solid& inner, const Transformation& t, const Solid& outer,
                 double tolerance) {
  const auto* tube = tube_of(outer);
  return tube != nullptr && reach_across(inner, t) <= tube->rmin + tolerance;
}

/// Are both tubes about one axis, with the radii and ends of `inner` within those of `outer`?
bool within_tube(const PlacedSolid& inner, const Solid& outer, double tolerance) {
  const auto *in = tube_of(inner.solid), *out = tube_of(outer);
  return in != nullptr && out != nullptr && whole(out->wedge) &&
         on_one_axis(inner.transformation) && in->rmin >= out->rmin - tolerance &&
         in->rmax <= out->rmax + tolerance &&
         std::abs(inner.transformation.translation[2]) + in->hz <= out->hz + tolerance;
}

}  // namespace

const SolidPoints& Separation::points_of(const Solid& solid) {
  const auto [entry, fresh] = points_.try_emplace(solid.shape.get());
  if (fresh) entry->second = sample_points(solid, surface_points_of_each, rounding_, seed);
  return entry->second;
}

Certainty Separation::within(const PlacedSolid& inner, const Solid& outer) {
  if (outer.kind == SolidKind::box &&
      holds(outer.extent, placed_extent(inner.solid, inner.transformation), tolerance_)) {
    return Certainty::proved;
  }
  if (within_tube(inner, outer, tolerance_)) return Certainty::proved;
  const auto outside = [&](const Vec3& p) {
    return kernels::inside(outer.any(), p, tolerance_) == Side::outside;
  };
  if (convex(outer) || inner.solid.kind == SolidKind::box) {
    bool all = true;
    for_each_corner(inner, [&](const Vec3& p) { all = all && !outside(p); });
    if (all && convex(outer)) return Certainty::proved;
    if (!all && inner.solid.kind == SolidKind::box) return Certainty::no;
  }
  const SolidPoints& points = points_of(inner.solid);
  if (points.surface.empty()) return Certainty::no;
  for (const Vec3& p : points.surface) {
    if (outside(to_outer(inner.transformation, p))) return Certainty::no;
  }
  for (const Vec3& p : points.interior) {
    if (outside(to_outer(inner.transformation, p))) return Certainty::no;
  }
  for (const Vec3& p : corner_points(inner.solid, tolerance_)) {
    if (outside(to_outer(inner.transformation, p))) return Certainty::no;
  }
  if (holds_hole_of(inner, outer)) return Certainty::no;
  const auto beyond =
      find_point_beyond(inner, outer, lines_through_each, tolerance_, rounding_, seed);
  return beyond ? Certainty::no : Certainty::sampled;
}

/// Does `inner` fill a part of a bore or a notch of `outer`, in whose frame it is placed? If so,
/// `outer` has points of its surface, or none at all, where `inner` is.
bool Separation::holds_hole_of(const PlacedSolid& inner, const Solid& outer) {
  const auto holds = [&](const Vec3& p) {
    return kernels::inside(inner.solid.any(), to_local(inner.transformation, p), tolerance_) ==
           Side::inside;
  };
  const std::vector<Vec3>& surface = points_of(outer).surface;
  const std::vector<Vec3> bore = bore_points(outer, tolerance_);
  return std::any_of(surface.begin(), surface.end(), holds) ||
         std::any_of(bore.begin(), bore.end(), holds);
}

/// Does a point of `a` lie in `b`?
bool Separation::reaches_into(const PlacedSolid& a, const PlacedSolid& b) {
  const SolidPoints& points = points_of(a.solid);
  for (const auto* some : {&points.surface, &points.interior}) {
    for (const Vec3& local : *some) {
      const Vec3 p = to_local(b.transformation, to_outer(a.transformation, local));
      if (kernels::inside(b.solid.any(), p, tolerance_) == Side::inside) return true;
    }
  }
  return points.surface.empty();
}

Certainty Separation::apart(const PlacedSolid& a, const PlacedSolid& b) {
  if (!boxes_meet(a, b, tolerance_)) return Certainty::proved;
  if (tube_of(a.solid) != nullptr || tube_of(b.solid) != nullptr) {
    try {
      if (in_the_bore(a.solid, between(b, a), b.solid, tolerance_) ||
          in_the_bore(b.solid, between(a, b), a.solid, tolerance_)) {
        return Certainty::proved;
      }
    } catch (const GeometryError&) {
      // The product of two rotations that are orthonormal enough may not be so itself.
    }
  }
  if (reaches_into(a, b) || reaches_into(b, a)) return Certainty::no;
  const auto shared = find_shared_point(a, b, lines_of_each_pair, tolerance_, rounding_, seed);
  return shared ? Certainty::no : Certainty::sampled;
}

}  // namespace navjit
