// The canonical arithmetic of frames. Every navigator, generic or specialised, composes and applies
// transformations by these formulas and no others: that is what makes their answers equal to the
// last bit.
//
//   local = R * (global - T),   R row-major, T the local origin in the outer frame
//
// A term is dropped only where its factor is exactly 0, a product only where it is exactly 1 or -1.
// Directions get +0 added to each component, so that dropping terms cannot change the sign of a
// zero. See docs/numerics.md.
#pragma once

#include "geometry/solids/solid.hpp"

namespace navjit {

/// Mother-to-daughter transformation of a placement.
struct Transformation {
  double translation[3] = {0, 0, 0};                 ///< daughter's origin in the mother, mm
  double rotation[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< mother-to-daughter, row-major
  bool rotated = false;                              ///< false: rotation is the identity

  friend bool operator==(const Transformation&, const Transformation&) = default;
};

/// Builds a transformation; entries of the rotation within 1e-15 of 0, 1 or -1 (what sines and
/// cosines of right angles leave) become exact. Throws GeometryError if a number is not finite or
/// the matrix is not orthonormal to 1e-6.
Transformation make_transformation(const double (&translation)[3], const double (&rotation)[9]);
/// The rotation of Geant4's GDML reader: mother-to-daughter = Rz(z) * Ry(y) * Rx(x), rad.
void rotation_from_angles(double x, double y, double z, double (&rotation)[9]);
/// The transformation into `inner`, which is placed in the frame that `outer` places.
Transformation compose(const Transformation& outer, const Transformation& inner);

/// A row of a rotation times (x, y, z): the one place that fixes the order of operations.
inline double rotate_row(const double* r, double x, double y, double z) {
  return r[0] * x + r[1] * y + r[2] * z;
}

inline Vec3 to_local(const Transformation& t, const Vec3& p) {
  const double x = p.x - t.translation[0], y = p.y - t.translation[1], z = p.z - t.translation[2];
  if (!t.rotated) return {x, y, z};
  const double* r = t.rotation;
  return {rotate_row(r, x, y, z), rotate_row(r + 3, x, y, z), rotate_row(r + 6, x, y, z)};
}

/// The inverse for points, for sampling and checks; navigation never needs it.
inline Vec3 to_outer(const Transformation& t, const Vec3& p) {
  const double* r = t.rotation;
  return {t.translation[0] + r[0] * p.x + r[3] * p.y + r[6] * p.z,
          t.translation[1] + r[1] * p.x + r[4] * p.y + r[7] * p.z,
          t.translation[2] + r[2] * p.x + r[5] * p.y + r[8] * p.z};
}

inline Direction to_local(const Transformation& t, const Direction& v) {
  if (!t.rotated) return v;
  const double* r = t.rotation;
  return kernels::make_direction(rotate_row(r, v.x, v.y, v.z), rotate_row(r + 3, v.x, v.y, v.z),
                                 rotate_row(r + 6, v.x, v.y, v.z));
}

}  // namespace navjit
