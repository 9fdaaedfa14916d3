// What the makers of solids share. Private to geometry/solids.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/solids/extent.hpp"
#include "geometry/solids/solid.hpp"

namespace navjit::detail {

/// Throws GeometryError unless the condition holds: "solid 'N': WHAT".
void require(bool condition, const std::string& solid_name, const char* what);
/// Throws unless an operand has a shape, as whatever a maker returns has.
void require_shape(const Solid& operand, const std::string& solid_name);
/// Throws unless all values are finite.
void require_finite(std::initializer_list<double> values, const std::string& solid_name);

/// Eight values value(first), ...; from index `count` on all are value(count - 1).
template <class Value>
kernels::EightOf<double> eight_from(std::size_t first, std::size_t count, const Value& value) {
  const auto at = [&](std::size_t lane) { return value(std::min(first + lane, count - 1)); };
  return {at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)};
}

struct UnitVector {
  double x, y;
};
/// (cos, sin) of an angle; exact for multiples of a right angle.
UnitVector unit_vector(double angle);

/// The conical face through radius r_low at z = 0 and r_high at z = length > 0.
kernels::ConicalFace<double> conical_face(double r_low, double r_high, double length);

/// The wedge for [start, start + delta], rad. A delta within 1e-9 of a full turn is a full turn;
/// sines and cosines of right angles are exact.
kernels::Wedge<double> make_wedge(double start, double delta, const std::string& solid_name);
/// The extent in x and y of the annulus sector rmin..rmax within the wedge.
Extent sector_extent(double rmin, double rmax, double start, double delta, double zmin,
                     double zmax);

/// The angle of what the wedge keeps, rad.
double angle_of(const kernels::Wedge<double>& w);
/// The integral of the squared radius over z in [from, to].
double squared_radius_integral(const kernels::ConicalFace<double>& f, double from, double to);
/// The radius of a face at z; `flat` if the face is nearly a plane across the axis.
double radius_at(const kernels::ConicalFace<double>& face, double z, double flat);

template <class Shape>
Solid make_solid(std::string name, SolidKind kind, const Shape& shape, const Extent& extent) {
  return {std::move(name), kind, std::make_shared<const Shape>(shape), extent};
}

}  // namespace navjit::detail
