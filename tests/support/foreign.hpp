// Solids as another engine would answer for them.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "geometry/solids/solid.hpp"
#include "navjit/foreign_solid.hpp"

namespace navjit::tests {

/// A ball, by textbook formulas that are independent of the library.
class Ball : public ForeignSolid {
 public:
  explicit Ball(double radius) : radius_(radius) {}

  PointSide inside(const Vec3& p) const override {
    const double depth = radius_ - norm(p);
    if (depth > tolerance()) return PointSide::inside;
    return depth < -tolerance() ? PointSide::outside : PointSide::surface;
  }
  double distance_to_in(const Vec3& p, const Vec3& v) const override {
    const double b = dot(p, v), c = dot(p, p) - radius_ * radius_, root = b * b - c;
    if (b >= 0 || root <= 0) return infinite;
    return inside(p) == PointSide::surface ? 0 : c / (std::sqrt(root) - b);
  }
  double distance_to_out(const Vec3& p, const Vec3& v) const override {
    const double b = dot(p, v), c = dot(p, p) - radius_ * radius_, root = b * b - c;
    if (root <= 0 || (b >= 0 && inside(p) == PointSide::surface)) return 0;
    return b > 0 ? -c / (std::sqrt(root) + b) : std::sqrt(root) - b;
  }
  double safety_to_in(const Vec3& p) const override { return norm(p) - radius_; }
  double safety_to_out(const Vec3& p) const override { return radius_ - norm(p); }
  Vec3 normal(const Vec3& p) const override { return 1 / norm(p) * p; }
  double volume() const override { return 4 * M_PI / 3 * radius_ * radius_ * radius_; }
  std::string key() const override { return "ball of " + std::to_string(radius_); }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  double radius_;
};

inline Solid foreign_ball(const std::string& name, double radius) {
  return make_foreign(name, std::make_shared<Ball>(radius),
                      {{-radius, -radius, -radius}, {radius, radius, radius}});
}

/// A solid of the library behind the functions of a foreign one, with a thicker surface.
class Disguised : public ForeignSolid {
 public:
  explicit Disguised(Solid solid) : solid_(std::move(solid)) {}

  PointSide inside(const Vec3& p) const override {
    return static_cast<PointSide>(kernels::inside(solid_.any(), p, tolerance()));
  }
  double distance_to_in(const Vec3& p, const Vec3& v) const override {
    return kernels::distance_to_in(solid_.any(), p, along(v), tolerance());
  }
  double distance_to_out(const Vec3& p, const Vec3& v) const override {
    return kernels::distance_to_out(solid_.any(), p, along(v), tolerance());
  }
  double safety_to_in(const Vec3& p) const override {
    return kernels::safety_to_in(solid_.any(), p);
  }
  double safety_to_out(const Vec3& p) const override {
    return kernels::safety_to_out(solid_.any(), p);
  }
  Vec3 normal(const Vec3& p) const override {
    return kernels::normal(solid_.any(), p, tolerance());
  }
  double volume() const override { return capacity(solid_); }

 private:
  static kernels::Direction<double> along(const Vec3& v) {
    return kernels::make_direction(v.x, v.y, v.z);
  }
  Solid solid_;
};

inline Solid disguised(const Solid& solid) {
  return make_foreign(solid.name, std::make_shared<Disguised>(solid), solid.extent);
}

}  // namespace navjit::tests
