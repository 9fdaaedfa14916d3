// Solids of others, which answer for themselves (navjit/foreign_solid.hpp). Here their answers are
// made into those of kernels: on the surface the direction decides.
#pragma once

#include <array>

#include "geometry/solids/facts.hpp"
#include "navjit/foreign_solid.hpp"

namespace navjit::kernels {

/// Does not own the solid (navjit::Solid does).
struct ForeignShape {
  const ForeignSolid* solid;
  double tolerance;  ///< the solid's own, mm
};
template <class Real>
using Foreign = ForeignShape;

}  // namespace navjit::kernels

namespace navjit::foreign {

using kernels::ForeignShape;

kernels::Side inside(const ForeignShape& s, const Vec3& p);
bool contains(const ForeignShape& s, const Vec3& p, const Vec3& v);
double distance_to_in(const ForeignShape& s, const Vec3& p, const Vec3& v);
double distance_to_out(const ForeignShape& s, const Vec3& p, const Vec3& v);
double safety_to_in(const ForeignShape& s, const Vec3& p);
double safety_to_out(const ForeignShape& s, const Vec3& p);
Vec3 normal(const ForeignShape& s, const Vec3& p);

/// A point or vector of any kind of number, converted to double.
template <class Vector>
Vec3 narrow(const Vector& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

}  // namespace navjit::foreign

// These follow the conventions of all kernels (geometry/kernels/prelude.h).
namespace navjit::kernels {

template <class Real>
Side inside(const ForeignShape& s, const Vec3<Real>& p, Real) {
  return foreign::inside(s, foreign::narrow(p));
}
template <class Real>
bool contains(const ForeignShape& s, const Vec3<Real>& p, const Direction<Real>& v, Real) {
  return foreign::contains(s, foreign::narrow(p), foreign::narrow(v));
}
template <class Real>
Real distance_to_in(const ForeignShape& s, const Vec3<Real>& p, const Direction<Real>& v, Real) {
  return static_cast<Real>(foreign::distance_to_in(s, foreign::narrow(p), foreign::narrow(v)));
}
template <class Real>
Real distance_to_out(const ForeignShape& s, const Vec3<Real>& p, const Direction<Real>& v, Real) {
  return static_cast<Real>(foreign::distance_to_out(s, foreign::narrow(p), foreign::narrow(v)));
}
template <class Real>
Real safety_to_in(const ForeignShape& s, const Vec3<Real>& p) {
  return static_cast<Real>(foreign::safety_to_in(s, foreign::narrow(p)));
}
template <class Real>
Real safety_to_out(const ForeignShape& s, const Vec3<Real>& p) {
  return static_cast<Real>(foreign::safety_to_out(s, foreign::narrow(p)));
}
template <class Real>
Vec3<Real> normal(const ForeignShape& s, const Vec3<Real>& p, Real) {
  const auto n = foreign::normal(s, foreign::narrow(p));
  return {static_cast<Real>(n.x), static_cast<Real>(n.y), static_cast<Real>(n.z)};
}

}  // namespace navjit::kernels

namespace navjit {

template <>
struct SolidFacts<kernels::ForeignShape> {
  using Shape = kernels::ForeignShape;

  static constexpr std::array<const char*, 0> kernel_files{};
  static double volume(const Shape& s) { return s.solid->volume(); }
};

}  // namespace navjit
