#include "geometry/model/transformation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace navjit {
namespace {

constexpr double pi = std::numbers::pi;

Transformation placed(double x, double y, double z, double ax, double ay, double az) {
  double rotation[9];
  rotation_from_angles(ax, ay, az, rotation);
  return make_transformation({x, y, z}, rotation);
}

void expect_rows(const double (&r)[9], const double (&expected)[9]) {
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(r[i], expected[i], 1e-15) << i;
}

TEST(Transformation, RotatesAboutOneAxis) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  double r[9];
  rotation_from_angles(0.3, 0, 0, r);
  expect_rows(r, {1, 0, 0, 0, c, -s, 0, s, c});
  rotation_from_angles(0, 0.3, 0, r);
  expect_rows(r, {c, 0, s, 0, 1, 0, -s, 0, c});
  rotation_from_angles(0, 0, 0.3, r);
  expect_rows(r, {c, -s, 0, s, c, 0, 0, 0, 1});
}

TEST(Transformation, RotatesAboutXThenYThenZ) {
  // Rz Ry Rx, multiplied by hand: x goes to y under Ry = 1, Rz = 90 degrees.
  double r[9];
  rotation_from_angles(pi / 2, 0, pi / 2, r);
  expect_rows(r, {0, 0, 1, 1, 0, 0, 0, 1, 0});
  rotation_from_angles(pi / 2, pi / 2, 0, r);
  expect_rows(r, {0, 1, 0, 0, 0, -1, -1, 0, 0});
}

TEST(Transformation, RightAnglesAreExact) {
  for (int x = -8; x <= 8; ++x) {
    for (int y = -8; y <= 8; ++y) {
      const Transformation t = placed(0, 0, 0, x * 90 * (pi / 180), y * 90 * (pi / 180), pi);
      for (const double entry : t.rotation) {
        EXPECT_TRUE(entry == 0 || entry == 1 || entry == -1) << entry;
        EXPECT_FALSE(entry == 0 && std::signbit(entry)) << "negative zero";
      }
    }
  }
  EXPECT_FALSE(placed(1, 2, 3, 2 * pi, 0, -2 * pi).rotated);
  EXPECT_TRUE(placed(1, 2, 3, pi, 0, 0).rotated);
  // What is meant to be small stays.
  EXPECT_TRUE(placed(0, 0, 0, 1e-12, 0, 0).rotated);
}

TEST(Transformation, HasNoNegativeZeros) {
  const Transformation t = make_transformation({-0.0, -0.0, -0.0}, {1, -0.0, 0, 0, 1, 0, 0, 0, 1});
  EXPECT_EQ(t, Transformation{});
  EXPECT_FALSE(std::signbit(t.translation[0]));
  EXPECT_FALSE(std::signbit(t.rotation[1]));
}

TEST(Transformation, TakesPointsAndDirectionsToLocal) {
  const Transformation t = placed(1, 2, 3, 0, 0, pi / 2);
  const Vec3 p = to_local(t, Vec3{2, 2, 3});
  EXPECT_EQ(p.x, 0);
  EXPECT_EQ(p.y, 1);
  EXPECT_EQ(p.z, 0);
  const Direction v = to_local(t, kernels::make_direction(0.0, 1.0, 0.0));
  EXPECT_EQ(v.x, -1);
  EXPECT_EQ(v.y, 0);
  EXPECT_EQ(v.inverse_x, -1);
  EXPECT_FALSE(std::signbit(v.y));
}

TEST(Transformation, ComposesAsIfAppliedInTurn) {
  const Transformation outer = placed(10, -20, 30, 0.1, 0.2, 0.3);
  const Transformation inner = placed(-1, 2, 5, -0.5, 1.1, 2.3);
  const Transformation both = compose(outer, inner);
  for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{5, -7, 11}, Vec3{-100, 3, 0.5}}) {
    const Vec3 expected = to_local(inner, to_local(outer, p));
    const Vec3 local = to_local(both, p);
    EXPECT_NEAR(local.x, expected.x, 1e-12);
    EXPECT_NEAR(local.y, expected.y, 1e-12);
    EXPECT_NEAR(local.z, expected.z, 1e-12);
  }
  EXPECT_EQ(compose(Transformation{}, inner), inner);
  EXPECT_EQ(compose(outer, Transformation{}), outer);
  // A half turn and back is no turn at all.
  EXPECT_FALSE(compose(placed(0, 0, 0, 0, pi, 0), placed(0, 0, 0, 0, -pi, 0)).rotated);
}

TEST(Transformation, RefusesWhatIsNoFrame) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  EXPECT_THROW(make_transformation({nan, 0, 0}, identity), GeometryError);
  EXPECT_THROW(make_transformation({0, INFINITY, 0}, identity), GeometryError);
  EXPECT_THROW(make_transformation({0, 0, 0}, {nan, 0, 0, 0, 1, 0, 0, 0, 1}), GeometryError);
  EXPECT_THROW(make_transformation({0, 0, 0}, {2, 0, 0, 0, 1, 0, 0, 0, 1}), GeometryError);
  EXPECT_THROW(make_transformation({0, 0, 0}, {1, 1, 0, 0, 1, 0, 0, 0, 1}), GeometryError);
  EXPECT_THROW(make_transformation({0, 0, 0}, {0, 0, 0, 0, 0, 0, 0, 0, 0}), GeometryError);
}

}  // namespace
}  // namespace navjit
