// Where a daughter is, as seen from an axis of its mother or from the mother's origin.
#pragma once

#include <optional>

#include "geometry/navigation/geometry.hpp"

namespace navjit {

/// Distances are from the axis, mm; the azimuth is anticlockwise about the axis, rad. All numbers
/// are bounds: the daughter is nowhere else, up to rounding.
struct AxialExtent {
  double near = 0, far = 0;
  double low = 0, high = 0;  ///< along the axis, mm
  bool around = true;        ///< the azimuth is not limited
  double first = 0;          ///< the azimuth where the daughter begins, in [-pi, pi]
  double span = 0;           ///< how far the daughter reaches from there, < 2 pi
  bool segment = false;      ///< the solid is a segment about the axis, of exactly these azimuths
};

/// The extent seen from an axis through the mother's origin: 0, 1 or 2 for x, y or z. The azimuth
/// is measured from y, z or x, respectively.
AxialExtent axial_extent(const Solid& solid, const Transformation& transformation, int axis);

/// A range of tangents to a circle about an axis. A tangent is given by the azimuth of the
/// direction in which it leads away from the circle, anticlockwise, rad. Every point outside of the
/// circle is on one tangent.
struct TangentSpan {
  double first = 0;  ///< in (-pi, pi]
  double span = 0;   ///< < pi
};

/// The tangents on which a daughter has points; nothing unless all of the daughter is well outside
/// of the circle. `lean` is the circle's radius, mm. Seen outwards the tangents have the axis on
/// their right, or on their left if `lean` is negative; if it is 0 they are radii.
std::optional<TangentSpan> tangent_span(const Solid& solid, const Transformation& transformation,
                                        int axis, double lean);

/// The circle whose tangents separate the daughter best from its neighbours in a ring, as `lean` of
/// tangent_span(). An edge of the daughter's box is a tangent of this circle. The result is 0, for
/// radii, unless the daughter has points on far fewer of these tangents than of radii.
double lean_of(const Solid& solid, const Transformation& transformation, int axis);

/// The extent seen from the mother's origin, of which only `near` and `far` count.
AxialExtent central_extent(const Solid& solid, const Transformation& transformation);

}  // namespace navjit
