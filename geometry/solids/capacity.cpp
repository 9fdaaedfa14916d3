// Volumes of solids of any kind, in closed form.
#include <cmath>
#include <limits>

#include "geometry/solids/make.hpp"
#include "geometry/solids/solid.hpp"

namespace navjit {
namespace {

double volume(const kernels::AnySolid<double>& s);

template <class Shape>
double volume(const Shape& s) {
  return SolidFacts<Shape>::volume(s);
}
double volume(const kernels::AnyPlaced<double>& s) { return volume(s.solid); }
double volume(const kernels::AnyScaled<double>& s) {
  return volume(s.solid) / std::abs(s.inverse_x * s.inverse_y * s.inverse_z);
}
template <template <class, class> class Boolean, class Operand>
double volume(const Boolean<Operand, Operand>&) {
  return std::numeric_limits<double>::quiet_NaN();
}

double volume(const kernels::AnyUnion<double>&) { return std::numeric_limits<double>::quiet_NaN(); }

double volume(const kernels::AnySolid<double>& s) {
  return kernels::visit(s, [](const auto& shape) { return volume(shape); });
}

}  // namespace

double capacity(const Solid& solid) {
  detail::require_shape(solid, solid.name);
  return volume(solid.any());
}

}  // namespace navjit
