// Where a daughter is as seen from an axis of its mother, or from the mother's origin.
#pragma once

#include <optional>

#include "geometry/navigation/geometry.hpp"

namespace navjit {

/// Distances are from the axis, mm; the azimuth is anticlockwise about it, rad. All are bounds: the
/// daughter is nowhere else, up to rounding.
struct AxialExtent {
  double near = 0, far = 0;
  double low = 0, high = 0;  ///< along the axis, mm
  bool around = true;        ///< the azimuth is not limited
  double first = 0;          ///< azimuth where it begins, in [-pi, pi]
  double span = 0;           ///< and how far it reaches from there, < 2 pi
  bool segment = false;      ///< it is cut to just that, about the axis
};

/// As seen from the mother's axis 0, 1, 2 for x, y, z through its origin. The azimuth is from y, z
/// or x, in this order.
AxialExtent axial_extent(const Solid& solid, const Transformation& transformation, int axis);

/// Azimuths of tangents to a circle about an axis, anticlockwise, rad: the tangent that a point is
/// on, seen away from the circle.
struct TangentSpan {
  double first = 0;  ///< in (-pi, pi]
  double span = 0;   ///< < pi
};

/// On which tangents a daughter is; nothing if it is not all well outside of the circle. `lean`:
/// the circle's radius, mm. Seen outwards the tangents have the axis on their right, or on their
/// left where `lean` is negative; for 0 they are radii.
std::optional<TangentSpan> tangent_span(const Solid& solid, const Transformation& transformation,
                                        int axis, double lean);

/// The circle whose tangents tell the daughter best from its neighbours in a ring: one that an edge
/// of its box is a tangent of, if the daughter is on much fewer of its tangents than on radii;
/// else 0.
double lean_of(const Solid& solid, const Transformation& transformation, int axis);

/// As seen from the mother's origin: only near and far.
AxialExtent central_extent(const Solid& solid, const Transformation& transformation);

}  // namespace navjit
