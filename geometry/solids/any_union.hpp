// Unions of any solids: asked by their two operands or, if they have many parts, by all boxes.
#pragma once

#include <type_traits>

#include "geometry/solids/boolean.hpp"

namespace navjit::kernels {

// For many parts, in double precision (union_parts.cpp).
bool is_wide_enough(const UnionParts& s, double tol);
bool contains(const UnionParts& s, const Vec3<double>& p, const Direction<double>& v, double tol);
double furthest_out(const UnionParts& s, const Vec3<double>& p, const Direction<double>& v,
                    double tol);
double nearest_in(const UnionParts& s, const Vec3<double>& p, const Direction<double>& v,
                  double best, double tol);
double safety_to_in(const UnionParts& s, const Vec3<double>& p);
double safety_to_out(const UnionParts& s, const Vec3<double>& p);

template <class Real>
using UnionPair = Union<const AnyOperand<Real>&, const AnyOperand<Real>&>;

/// Returns ask(parts), or ask(the two operands).
template <class Real, class Ask>
auto ask_union(const AnyUnion<Real>& s, Real tol, const Ask& ask) {
  if constexpr (std::is_same_v<Real, double>) {
    if (s.parts != nullptr && is_wide_enough(*s.parts, tol)) return ask(*s.parts);
  }
  return ask(UnionPair<Real>{s.a, s.b});
}

template <class Real>
Side inside(const AnyUnion<Real>& s, const Vec3<Real>& p, Real tol) {
  return inside(UnionPair<Real>{s.a, s.b}, p, tol);
}
template <class Real>
bool contains(const AnyUnion<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return ask_union(s, tol, [&](const auto& u) { return contains(u, p, v, tol); });
}
template <class Real>
Real furthest_out(const AnyUnion<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                  Real tol) {
  return ask_union(s, tol, [&](const auto& u) { return furthest_out(u, p, v, tol); });
}
template <class Real>
Real nearest_in(const AnyUnion<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real best,
                Real tol) {
  return ask_union(s, tol, [&](const auto& u) { return nearest_in(u, p, v, best, tol); });
}
template <class Real>
Real distance_to_in(const AnyUnion<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                    Real tol) {
  return distance_to_nearest_part(s, p, v, tol);
}
template <class Real>
Real distance_to_out(const AnyUnion<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  return distance_through_parts(s, p, v, tol);
}
template <class Real>
Real safety_to_in(const AnyUnion<Real>& s, const Vec3<Real>& p) {
  if constexpr (std::is_same_v<Real, double>) {
    if (s.parts != nullptr) return safety_to_in(*s.parts, p);
  }
  return safety_to_in(UnionPair<Real>{s.a, s.b}, p);
}
template <class Real>
Real safety_to_out(const AnyUnion<Real>& s, const Vec3<Real>& p) {
  if constexpr (std::is_same_v<Real, double>) {
    if (s.parts != nullptr) return safety_to_out(*s.parts, p);
  }
  return safety_to_out(UnionPair<Real>{s.a, s.b}, p);
}
template <class Real>
Vec3<Real> normal(const AnyUnion<Real>& s, const Vec3<Real>& p, Real tol) {
  return normal(UnionPair<Real>{s.a, s.b}, p, tol);
}

}  // namespace navjit::kernels
