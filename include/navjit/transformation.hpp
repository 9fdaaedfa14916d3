// Frames: where a volume is in another one.
//
// These are the canonical formulas. Every navigator, generic or specialised, composes and applies
// transformations by them and no others: that is what makes their answers equal to the last bit.
//
//   local = R * (outer - T),   R row-major, T the local origin in the outer frame
//
// A term is dropped only where its factor is exactly 0, a product only where it is exactly 1 or -1.
// docs/numerics.md has the reasons.
#pragma once

#include "navjit/detail/api.hpp"
#include "navjit/vector.hpp"

namespace NAVJIT_API navjit {

// All functions here are thread-safe.

/// From an outer frame (a mother's, or the world's) into a local one.
struct Transformation {
  double translation[3] = {0, 0, 0};                 ///< the local origin in the outer frame, mm
  double rotation[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< outer-to-local, row-major
  bool rotated = false;                              ///< false: rotation is the identity

  friend bool operator==(const Transformation&, const Transformation&) = default;
};

/// Builds a transformation; entries of the rotation within 1e-15 of 0, 1 or -1 (what sines and
/// cosines of right angles leave) become exact. A determinant of -1 is a reflection. Throws
/// GeometryError if a number is not finite or the matrix is not orthonormal to 1e-6.
Transformation make_transformation(const double (&translation)[3], const double (&rotation)[9]);
/// The rotation of Geant4's GDML reader: outer-to-local = Rz(z) * Ry(y) * Rx(x), rad.
void rotation_from_angles(double x, double y, double z, double (&rotation)[9]);
/// Both of the above: the local origin (mm) and GDML's angles (rad). Throws GeometryError if a
/// number is not finite.
Transformation placed_at(const Vec3& translation, const Vec3& angles = {0, 0, 0});
/// The transformation into `inner`, which is placed in the frame that `outer` places.
Transformation compose(const Transformation& outer, const Transformation& inner);

/// A row of a rotation times (x, y, z): the one place that fixes the order of operations.
inline double rotate_row(const double* r, double x, double y, double z) {
  return r[0] * x + r[1] * y + r[2] * z;
}

/// A point of the outer frame in the local one, mm.
inline Vec3 to_local(const Transformation& t, const Vec3& p) {
  const double x = p.x - t.translation[0], y = p.y - t.translation[1], z = p.z - t.translation[2];
  if (!t.rotated) return {x, y, z};
  const double* r = t.rotation;
  return {rotate_row(r, x, y, z), rotate_row(r + 3, x, y, z), rotate_row(r + 6, x, y, z)};
}

/// A point of the local frame in the outer one, mm.
inline Vec3 to_outer(const Transformation& t, const Vec3& p) {
  const double* r = t.rotation;
  return {t.translation[0] + r[0] * p.x + r[3] * p.y + r[6] * p.z,
          t.translation[1] + r[1] * p.x + r[4] * p.y + r[7] * p.z,
          t.translation[2] + r[2] * p.x + r[5] * p.y + r[8] * p.z};
}

/// A direction of the outer frame in the local one.
inline Vec3 direction_to_local(const Transformation& t, const Vec3& v) {
  if (!t.rotated) return v;
  const double* r = t.rotation;
  return {rotate_row(r, v.x, v.y, v.z), rotate_row(r + 3, v.x, v.y, v.z),
          rotate_row(r + 6, v.x, v.y, v.z)};
}

/// A direction of the local frame in the outer one.
inline Vec3 direction_to_outer(const Transformation& t, const Vec3& v) {
  if (!t.rotated) return v;
  const double* r = t.rotation;
  return {r[0] * v.x + r[3] * v.y + r[6] * v.z, r[1] * v.x + r[4] * v.y + r[7] * v.z,
          r[2] * v.x + r[5] * v.y + r[8] * v.z};
}

}  // namespace navjit
