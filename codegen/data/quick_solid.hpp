// Solids of any kind in scenes that are bound to data.
#pragma once

#include "geometry/navigation/scene.hpp"
#include "geometry/solids/any_solid.hpp"

namespace navjit::kernels {

/// Code that was compiled for one solid. The tolerance is a constant in it, and so are the solid's
/// numbers unless they are in `data`. It gives the same bits as the solid's own kernels, which are
/// called for safeties if there is no code for these.
struct SolidCode {
  AnySolid<double> solid;
  bool (*contains)(const void* data, const Vec3<double>&, const Direction<double>&);
  double (*distance_to_in)(const void* data, const Vec3<double>&, const Direction<double>&);
  double (*distance_to_out)(const void* data, const Vec3<double>&, const Direction<double>&);
  double (*safety_to_in)(const void* data,
                         const Vec3<double>&);  ///< null if there is no code for the safety
  double (*safety_to_out)(const void* data, const Vec3<double>&);  ///< null if safety_to_in is
  const void* data;
};

// These are out of line, because a switch over all kinds is much code, and instances inline all
// that they see.
bool contains_any(const AnySolid<double>& s, const Vec3<double>& p, const Direction<double>& v,
                  double tol);
double distance_to_in_any(const AnySolid<double>& s, const Vec3<double>& p,
                          const Direction<double>& v, double tol);
double distance_to_out_any(const AnySolid<double>& s, const Vec3<double>& p,
                           const Direction<double>& v, double tol);
double safety_to_in_any(const AnySolid<double>& s, const Vec3<double>& p);
double safety_to_out_any(const AnySolid<double>& s, const Vec3<double>& p);

/// A solid of any kind. Boxes, which are the most frequent, are tested for first, then solids with
/// code, then all others.
struct QuickSolid {
  SolidKind kind;
  bool has_code;
  const void* shape;  ///< of its kind, or its SolidCode if it has code

  bool is_box() const { return kind == SolidKind::box; }
  const Box<double>& box() const { return *static_cast<const Box<double>*>(shape); }
  const SolidCode& code() const { return *static_cast<const SolidCode*>(shape); }
  AnySolid<double> any() const { return {kind, shape}; }  ///< only if it has no code
};
static_assert(sizeof(QuickSolid) == sizeof(AnySolid<double>));

inline QuickSolid quick(const AnySolid<double>& solid) { return {solid.kind, false, solid.shape}; }
/// `code` is that of this solid, which must not be a box.
inline QuickSolid quick(const AnySolid<double>& solid, const SolidCode* code) {
  return {solid.kind, true, code};
}

/// Must be called only for solids of a kind that may be left for good.
inline bool is_left_for_good(const QuickSolid& s, const Vec3<double>& p, double tol) {
  const void* const shape = s.has_code ? s.code().solid.shape : s.shape;
  if (s.kind == SolidKind::tube) {
    return is_left_for_good(*static_cast<const Tube<double>*>(shape), p, tol);
  }
  if (s.kind == SolidKind::cone) {
    return is_left_for_good(*static_cast<const Cone<double>*>(shape), p, tol);
  }
  return true;
}
inline bool contains(const QuickSolid& s, const Vec3<double>& p, const Direction<double>& v,
                     double tol) {
  if (s.is_box()) return contains(s.box(), p, v, tol);
  if (s.has_code) return s.code().contains(s.code().data, p, v);
  return contains_any(s.any(), p, v, tol);
}
inline double distance_to_in(const QuickSolid& s, const Vec3<double>& p, const Direction<double>& v,
                             double tol) {
  if (s.is_box()) return distance_to_in(s.box(), p, v, tol);
  if (s.has_code) return s.code().distance_to_in(s.code().data, p, v);
  return distance_to_in_any(s.any(), p, v, tol);
}
inline double distance_to_entry(const QuickSolid& s, const Vec3<double>& p,
                                const Direction<double>& v, double tol) {
  return s.is_box() ? distance_to_entry(s.box(), p, v, tol) : distance_to_in(s, p, v, tol);
}
inline double distance_to_out(const QuickSolid& s, const Vec3<double>& p,
                              const Direction<double>& v, double tol) {
  if (s.has_code) return s.code().distance_to_out(s.code().data, p, v);
  return distance_to_out_any(s.any(), p, v, tol);
}
inline double safety_to_in(const QuickSolid& s, const Vec3<double>& p) {
  if (!s.has_code) return safety_to_in_any(s.any(), p);
  const SolidCode& code = s.code();
  return code.safety_to_in != nullptr ? code.safety_to_in(code.data, p)
                                      : safety_to_in_any(code.solid, p);
}
inline double safety_to_out(const QuickSolid& s, const Vec3<double>& p) {
  if (!s.has_code) return safety_to_out_any(s.any(), p);
  const SolidCode& code = s.code();
  return code.safety_to_out != nullptr ? code.safety_to_out(code.data, p)
                                       : safety_to_out_any(code.solid, p);
}

}  // namespace navjit::kernels
