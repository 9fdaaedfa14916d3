// A solid whose kind is known at run time only: one switch in front of the kernels. Booleans over
// any solids are the kernel templates instantiated with AnySolid itself.
#pragma once

#include "geometry/solids/kernels.hpp"
#include "navjit/solid_kind.hpp"

namespace navjit::kernels {

/// A pointer to a kernel's shape with its kind. Does not own the shape (navjit::Solid does).
template <class Real>
struct AnySolid {
  SolidKind kind;
  const void* shape;
};

template <class Real>
using AnyPlaced = Placed<Real, AnySolid<Real>>;
template <class Real>
using AnyScaled = Scaled<Real, AnySolid<Real>>;
template <class Real>
using AnyOperand = Boxed<Real, AnySolid<Real>>;
template <class Real>
using AnyUnion = Union<AnyOperand<Real>, AnyOperand<Real>>;
template <class Real>
using AnyIntersection = Intersection<AnyOperand<Real>, AnyOperand<Real>>;
template <class Real>
using AnySubtraction = Subtraction<AnyOperand<Real>, AnyOperand<Real>>;

/// Calls `f` with the shape as its own type.
template <class Real, class F>
decltype(auto) visit(const AnySolid<Real>& s, F&& f) {
  switch (s.kind) {
    case SolidKind::box:
      return f(*static_cast<const Box<Real>*>(s.shape));
    case SolidKind::tube:
      return f(*static_cast<const Tube<Real>*>(s.shape));
    case SolidKind::cone:
      return f(*static_cast<const Cone<Real>*>(s.shape));
    case SolidKind::trd:
      return f(*static_cast<const Trd<Real>*>(s.shape));
    case SolidKind::trap:
      return f(*static_cast<const Trap<Real>*>(s.shape));
    case SolidKind::hull:
      return f(*static_cast<const Hull<Real>*>(s.shape));
    case SolidKind::facets:
      return f(*static_cast<const Facets<Real>*>(s.shape));
    case SolidKind::prism:
      return f(*static_cast<const Prism<Real>*>(s.shape));
    case SolidKind::arb8:
      return f(*static_cast<const Arb8<Real>*>(s.shape));
    case SolidKind::cut_tube:
      return f(*static_cast<const CutTube<Real>*>(s.shape));
    case SolidKind::scaled:
      return f(*static_cast<const AnyScaled<Real>*>(s.shape));
    case SolidKind::orb:
      return f(*static_cast<const Orb<Real>*>(s.shape));
    case SolidKind::sphere:
      return f(*static_cast<const Sphere<Real>*>(s.shape));
    case SolidKind::polycone:
      return f(*static_cast<const Polycone<Real>*>(s.shape));
    case SolidKind::polyhedra:
      return f(*static_cast<const Polyhedra<Real>*>(s.shape));
    case SolidKind::twistedtubs:
      return f(*static_cast<const TwistedTube<Real>*>(s.shape));
    case SolidKind::twistedbox:
    case SolidKind::twistedtrd:
    case SolidKind::twistedtrap:
      return f(*static_cast<const TwistedTrap<Real>*>(s.shape));
    case SolidKind::torus:
      return f(*static_cast<const Torus<Real>*>(s.shape));
    case SolidKind::ellipsoid:
    case SolidKind::eltube:
    case SolidKind::elcone:
    case SolidKind::paraboloid:
    case SolidKind::hype:
      return f(*static_cast<const QuadricSolid<Real>*>(s.shape));
    case SolidKind::placed:
      return f(*static_cast<const AnyPlaced<Real>*>(s.shape));
    case SolidKind::union_of:
      return f(*static_cast<const AnyUnion<Real>*>(s.shape));
    case SolidKind::intersection_of:
      return f(*static_cast<const AnyIntersection<Real>*>(s.shape));
    case SolidKind::subtraction_of:
      return f(*static_cast<const AnySubtraction<Real>*>(s.shape));
  }
  __builtin_unreachable();
}

template <class Real>
Side inside(const AnySolid<Real>& s, const Vec3<Real>& p, Real tol) {
  return visit(s, [&](const auto& shape) { return inside(shape, p, tol); });
}
template <class Real>
bool contains(const AnySolid<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return visit(s, [&](const auto& shape) { return contains(shape, p, v, tol); });
}
template <class Real>
Real distance_to_in(const AnySolid<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                    Real tol) {
  return visit(s, [&](const auto& shape) { return distance_to_in(shape, p, v, tol); });
}
template <class Real>
Real distance_to_out(const AnySolid<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  return visit(s, [&](const auto& shape) { return distance_to_out(shape, p, v, tol); });
}
template <class Real>
Real safety_to_in(const AnySolid<Real>& s, const Vec3<Real>& p) {
  return visit(s, [&](const auto& shape) { return safety_to_in(shape, p); });
}
template <class Real>
Real safety_to_out(const AnySolid<Real>& s, const Vec3<Real>& p) {
  return visit(s, [&](const auto& shape) { return safety_to_out(shape, p); });
}

template <class Real>
Vec3<Real> normal(const AnySolid<Real>& s, const Vec3<Real>& p, Real tol) {
  return visit(s, [&](const auto& shape) { return normal(shape, p, tol); });
}

}  // namespace navjit::kernels
