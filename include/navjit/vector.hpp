// Points and vectors.
#pragma once

#include <cmath>

#include "navjit/detail/api.hpp"
#include "navjit/detail/vectors.h"

namespace NAVJIT_API navjit {

/// A point (mm) or a vector: x, y, z.
using Vec3 = kernels::Vec3<double>;

/// An axis-parallel box, mm.
struct Extent {
  Vec3 min, max;
};

}  // namespace navjit

// Arithmetic for callers, found by its arguments; navigation itself does not use it.
namespace navjit::kernels {

constexpr Vec3<double> operator+(const Vec3<double>& a, const Vec3<double>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3<double> operator-(const Vec3<double>& a, const Vec3<double>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3<double> operator*(double s, const Vec3<double>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
constexpr Vec3<double>& operator+=(Vec3<double>& a, const Vec3<double>& b) { return a = a + b; }
constexpr bool operator==(const Vec3<double>& a, const Vec3<double>& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}
/// Scalar product.
constexpr double dot(const Vec3<double>& a, const Vec3<double>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// Vector product.
constexpr Vec3<double> cross(const Vec3<double>& a, const Vec3<double>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Length.
inline double norm(const Vec3<double>& a) { return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z); }

}  // namespace navjit::kernels
