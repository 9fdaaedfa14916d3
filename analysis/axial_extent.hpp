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
  bool segment = false;      ///< the solid is a segment about the axis, of just these azimuths
};

/// As seen from the mother's axis 0, 1, 2 for x, y, z through its origin. The azimuth is from y, z
/// or x, in this order.
AxialExtent axial_extent(const Solid& solid, const Transformation& transformation, int axis);

/// A range of tangents to a circle about an axis. A tangent is given by its azimuth, anticlockwise,
/// rad: the direction in which it leads away from the circle. Every point outside of the circle is
/// on one.
struct TangentSpan {
  double first = 0;  ///< in (-pi, pi]
  double span = 0;   ///< < pi
};

/// The tangents that a daughter is on; nothing unless all of it is well outside of the circle.
/// `lean`: the circle's radius, mm. Seen outwards the tangents have the axis on their right, or on
/// their left where `lean` is negative; for 0 they are radii.
std::optional<TangentSpan> tangent_span(const Solid& solid, const Transformation& transformation,
                                        int axis, double lean);

/// The circle whose tangents tell the daughter best from its neighbours in a ring, as `lean` of
/// tangent_span(): one that an edge of the daughter's box is a tangent of. 0, for radii, unless the
/// daughter is on much fewer of its tangents than on radii.
double lean_of(const Solid& solid, const Transformation& transformation, int axis);

/// As seen from the mother's origin: only near and far.
AxialExtent central_extent(const Solid& solid, const Transformation& transformation);

}  // namespace navjit
