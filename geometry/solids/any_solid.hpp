// A solid whose kind is known at run time only: one switch in front of the kernels. Booleans over
// any solids are the kernel templates instantiated with AnySolid itself.
#pragma once

#include "geometry/solids/list.hpp"
#include "navjit/solid_kind.hpp"

namespace navjit::kernels {

/// A pointer to a kernel's shape with its kind. Does not own the shape (navjit::Solid does).
template <class Real>
struct AnySolid {
  SolidKind kind;
  const void* shape;
};

/// Is a function of its own, so that only it saves and clears wide registers.
template <class F, class Shape>
[[gnu::noinline]] decltype(auto) visit_apart(F& f, const Shape& shape) {
  return f(shape);
}
template <class F, class Shape>
[[gnu::always_inline]] inline decltype(auto) visit_shape(F& f, const Shape& shape) {
  if constexpr (uses_vectors<Shape>) {
    return visit_apart(f, shape);
  } else {
    return f(shape);
  }
}

/// Calls `f` with the shape as its own type.
template <class Real, class F>
decltype(auto) visit(const AnySolid<Real>& s, F&& f) {
  // Most solids and operands are boxes, moved or not: a branch on that is foreseen more often than
  // where a jump through a table goes.
  if (s.kind == SolidKind::box) return f(*static_cast<const Box<Real>*>(s.shape));
  if (s.kind == SolidKind::placed) {
    return f(*static_cast<const AnyPlaced<Real>*>(s.shape));
  }
  switch (s.kind) {
#define NAVJIT_LABEL(kind, name, Shape) case SolidKind::kind:
#define NAVJIT_CASE(kind, name, Shape) \
  case SolidKind::kind:                \
    return visit_shape(f, *static_cast<const Shape<Real>*>(s.shape));
    NAVJIT_SOLIDS(NAVJIT_CASE, NAVJIT_LABEL)
#undef NAVJIT_CASE
#undef NAVJIT_LABEL
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

// Booleans ask what their operands are made of.
template <class Real>
Real furthest_out(const AnySolid<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                  Real tol) {
  return visit(s, [&](const auto& shape) { return furthest_out(shape, p, v, tol); });
}
template <class Real>
Real nearest_in(const AnySolid<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real best,
                Real tol) {
  return visit(s, [&](const auto& shape) { return nearest_in(shape, p, v, best, tol); });
}
template <class Real>
bool come_into(const AnySolid<Real>& s, Approach<Real>& way) {
  return visit(s, [&](const auto& shape) { return come_into(shape, way); });
}

template <class Real>
Vec3<Real> normal(const AnySolid<Real>& s, const Vec3<Real>& p, Real tol) {
  return visit(s, [&](const auto& shape) { return normal(shape, p, tol); });
}

}  // namespace navjit::kernels
