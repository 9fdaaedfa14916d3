// Solids of data-bound scenes that may be of any kind.
#pragma once

#include "geometry/navigation/scene.hpp"
#include "geometry/solids/any_solid.hpp"

namespace navjit::kernels {

// Out of line: a switch over all kinds is much code, and instances inline all that they see.
bool contains_any(const AnySolid<double>& s, const Vec3<double>& p, const Direction<double>& v,
                  double tol);
double distance_to_in_any(const AnySolid<double>& s, const Vec3<double>& p,
                          const Direction<double>& v, double tol);
double distance_to_out_any(const AnySolid<double>& s, const Vec3<double>& p,
                           const Direction<double>& v, double tol);
double safety_to_in_any(const AnySolid<double>& s, const Vec3<double>& p);
double safety_to_out_any(const AnySolid<double>& s, const Vec3<double>& p);

/// Any solid; boxes, the commonest, go before the others.
struct QuickSolid {
  AnySolid<double> any;

  bool is_box() const { return any.kind == SolidKind::box; }
  const Box<double>& box() const { return *static_cast<const Box<double>*>(any.shape); }
};

inline bool contains(const QuickSolid& s, const Vec3<double>& p, const Direction<double>& v,
                     double tol) {
  return s.is_box() ? contains(s.box(), p, v, tol) : contains_any(s.any, p, v, tol);
}
inline double distance_to_in(const QuickSolid& s, const Vec3<double>& p, const Direction<double>& v,
                             double tol) {
  return s.is_box() ? distance_to_in(s.box(), p, v, tol) : distance_to_in_any(s.any, p, v, tol);
}
inline double distance_to_entry(const QuickSolid& s, const Vec3<double>& p,
                                const Direction<double>& v, double tol) {
  return s.is_box() ? distance_to_entry(s.box(), p, v, tol) : distance_to_in_any(s.any, p, v, tol);
}
inline double distance_to_out(const QuickSolid& s, const Vec3<double>& p,
                              const Direction<double>& v, double tol) {
  return distance_to_out_any(s.any, p, v, tol);
}
inline double safety_to_in(const QuickSolid& s, const Vec3<double>& p) {
  return safety_to_in_any(s.any, p);
}
inline double safety_to_out(const QuickSolid& s, const Vec3<double>& p) {
  return safety_to_out_any(s.any, p);
}

}  // namespace navjit::kernels
