#include "geometry/model/transformation.hpp"

#include <algorithm>
#include <cmath>

namespace navjit {
namespace {

constexpr double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

/// Corrects sines and cosines of right angles, which are wrong by a rounding. Adding +0 makes a
/// negative zero positive, so that equal frames have equal bits.
double rectified(double entry) {
  for (const double exact : {-1.0, 0.0, 1.0}) {
    if (std::abs(entry - exact) <= 1e-15) return exact;
  }
  return entry + 0.0;
}

bool orthonormal(const double (&r)[9]) {
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const double dot =
          r[3 * i] * r[3 * j] + r[3 * i + 1] * r[3 * j + 1] + r[3 * i + 2] * r[3 * j + 2];
      if (!(std::abs(dot - (i == j ? 1 : 0)) <= 1e-6)) return false;
    }
  }
  return true;
}

}  // namespace

Transformation make_transformation(const double (&translation)[3], const double (&rotation)[9]) {
  Transformation t;
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(translation[i])) {
      throw GeometryError("a position is not a finite number");
    }
    t.translation[i] = translation[i] + 0.0;
  }
  for (int i = 0; i < 9; ++i) {
    if (!std::isfinite(rotation[i])) {
      throw GeometryError("a rotation is not a finite number");
    }
    t.rotation[i] = rectified(rotation[i]);
  }
  if (!orthonormal(t.rotation)) {
    throw GeometryError("a rotation is not orthonormal");
  }
  t.rotated = !std::equal(std::begin(identity), std::end(identity), t.rotation);
  return t;
}

void rotation_from_angles(double x, double y, double z, double (&rotation)[9]) {
  const double sx = std::sin(x), cx = std::cos(x);
  const double sy = std::sin(y), cy = std::cos(y);
  const double sz = std::sin(z), cz = std::cos(z);
  const double product[9] = {cz * cy,
                             cz * sy * sx - sz * cx,
                             cz * sy * cx + sz * sx,
                             sz * cy,
                             sz * sy * sx + cz * cx,
                             sz * sy * cx - cz * sx,
                             -1 * sy,
                             cy * sx,
                             cy * cx};
  std::copy_n(product, 9, rotation);
}

Transformation placed_at(const Vec3& translation, const Vec3& angles) {
  double rotation[9];
  rotation_from_angles(angles.x, angles.y, angles.z, rotation);
  return make_transformation({translation.x, translation.y, translation.z}, rotation);
}

Transformation compose(const Transformation& outer, const Transformation& inner) {
  // local = Ri (Ro (p - To) - Ti) = (Ri Ro) (p - (To + Ro^T Ti))
  const double* ro = outer.rotation;
  const double* ri = inner.rotation;
  double translation[3], rotation[9];
  for (int i = 0; i < 3; ++i) {
    translation[i] =
        outer.translation[i] + (ro[i] * inner.translation[0] + ro[3 + i] * inner.translation[1] +
                                ro[6 + i] * inner.translation[2]);
    for (int j = 0; j < 3; ++j) {
      rotation[3 * i + j] =
          ri[3 * i] * ro[j] + ri[3 * i + 1] * ro[3 + j] + ri[3 * i + 2] * ro[6 + j];
    }
  }
  return make_transformation(translation, rotation);
}

}  // namespace navjit
