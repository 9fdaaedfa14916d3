#include <gtest/gtest.h>

#include <cmath>

#include "geometry/solids/widen.hpp"
#include "tests/support/foreign.hpp"

namespace navjit {
namespace {

constexpr double tolerance = 1e-11;

Direction along(const Vec3& v) { return kernels::make_direction(v.x, v.y, v.z); }
Vec3 unit(const Vec3& v) { return 1 / norm(v) * v; }

TEST(Foreign, IsASolidLikeOthers) {
  const Solid ball = tests::foreign_ball("ball", 20);
  EXPECT_EQ(ball.kind, SolidKind::foreign);
  EXPECT_STREQ(kind_name(ball.kind), "foreign");
  EXPECT_EQ(ball.name, "ball");
  EXPECT_EQ(ball.extent.max.y, 20);
  EXPECT_DOUBLE_EQ(capacity(ball), capacity(make_orb("orb", 20)));
  EXPECT_TRUE(std::isnan(capacity(make_union("u", ball, make_orb("b", 3)))));
}

TEST(Foreign, OnItsSurfaceTheDirectionDecides) {
  const Solid ball = tests::foreign_ball("ball", 20);
  const auto any = ball.any();
  const Vec3 top{0, 0, 20}, up{0, 0, 1}, down{0, 0, -1}, slanted = unit({1, 0, -1e-3});
  EXPECT_EQ(inside(any, top, tolerance), Side::surface);
  EXPECT_TRUE(contains(any, top, along(down), tolerance));
  EXPECT_FALSE(contains(any, top, along(up), tolerance));
  EXPECT_FALSE(contains(any, top, along({1, 0, 0}), tolerance)) << "it grazes";
  EXPECT_TRUE(contains(any, top, kernels::make_heading(0.0, 0.0, 0.0), tolerance));
  EXPECT_EQ(distance_to_in(any, top, along(down), tolerance), 0);
  EXPECT_EQ(distance_to_in(any, top, along(up), tolerance), INFINITY);
  EXPECT_EQ(distance_to_in(any, top, along({1, 0, 0}), tolerance), INFINITY);
  EXPECT_EQ(distance_to_out(any, top, along(up), tolerance), 0);
  EXPECT_NEAR(distance_to_out(any, top, along(down), tolerance), 40, 1e-12);
  EXPECT_NEAR(distance_to_out(any, top, along(slanted), tolerance), 0.04, 1e-6);
  EXPECT_EQ(distance_to_in(any, Vec3{1, 2, 3}, along(down), tolerance), INFINITY);
  EXPECT_EQ(normal(any, Vec3{0, 0, 21}, tolerance), up);
}

/// A ball that, as some solids do, reports the surface that a ray leaves as one that it comes to.
struct Forgetful : tests::Ball {
  using Ball::Ball;
  double distance_to_in(const Vec3& p, const Vec3& v) const override {
    return inside(p) == PointSide::surface ? 0 : Ball::distance_to_in(p, v);
  }
  double distance_to_out(const Vec3& p, const Vec3& v) const override {
    return inside(p) == PointSide::surface ? 0 : Ball::distance_to_out(p, v);
  }
};

TEST(Foreign, IsLeftAndEnteredAlthoughItSaysZeroOnItsSurface) {
  const Solid ball =
      make_foreign("ball", std::make_shared<Forgetful>(20), {{-20, -20, -20}, {20, 20, 20}});
  const auto any = ball.any();
  const Vec3 top{0, 0, 20};
  EXPECT_EQ(distance_to_in(any, top, along({0, 0, 1}), tolerance), INFINITY);
  EXPECT_EQ(distance_to_in(any, top, along({1, 0, 0}), tolerance), INFINITY);
  const double way = distance_to_in(any, top, along({0, 0, -1}), tolerance);
  EXPECT_GT(way, 0);
  EXPECT_LT(way, 1e-7);
  EXPECT_TRUE(contains(any, Vec3{0, 0, 20 - way}, along({0, 0, -1}), tolerance));
}

/// An L: at its inner edge the normal of one face points along the other face.
Solid corner() {
  const PlanarPoint polygon[] = {{-10, -10}, {10, -10}, {10, 0}, {0, 0}, {0, 10}, {-10, 10}};
  const ExtrudedSection sections[] = {{-10, 0, 0, 1}, {10, 0, 0, 1}};
  return make_extruded("corner", polygon, sections);
}

TEST(Foreign, AtEdgesAnswersAsTheSolidItself) {
  const Solid own = corner(), foreign = tests::disguised(own);
  for (const Vec3& edge : {Vec3{0, 0, 3}, Vec3{10, 0, 3}, Vec3{-10, 10, 3}, Vec3{0, 0, 10}}) {
    for (int i = 0; i < 360; i += 7) {
      const Vec3 v = unit({std::cos(i * 0.01745), std::sin(i * 0.01745), 0.1});
      const bool in = contains(own.any(), edge, along(v), tolerance);
      EXPECT_EQ(contains(foreign.any(), edge, along(v), tolerance), in) << i;
      const double to_in = distance_to_in(own.any(), edge, along(v), tolerance);
      if (in) {
        EXPECT_NEAR(distance_to_out(foreign.any(), edge, along(v), tolerance),
                    distance_to_out(own.any(), edge, along(v), tolerance), 1e-7);
      } else if (to_in == INFINITY) {
        EXPECT_EQ(distance_to_in(foreign.any(), edge, along(v), tolerance), INFINITY);
      } else {
        EXPECT_NEAR(distance_to_in(foreign.any(), edge, along(v), tolerance), to_in, 1e-7);
      }
    }
  }
}

TEST(Foreign, NumbersThatAreNoneCountAsNothing) {
  struct Broken : tests::Ball {
    using Ball::Ball;
    double distance_to_in(const Vec3&, const Vec3&) const override { return NAN; }
    double distance_to_out(const Vec3&, const Vec3&) const override { return -5; }
    double safety_to_in(const Vec3&) const override { return -1; }
    double safety_to_out(const Vec3&) const override { return NAN; }
    Vec3 normal(const Vec3&) const override { return {0, 0, 0}; }
  };
  const Solid ball = make_foreign("b", std::make_shared<Broken>(20), {{-9, -9, -9}, {9, 9, 9}});
  EXPECT_EQ(distance_to_in(ball.any(), Vec3{0, 0, 40}, along({0, 0, 1}), tolerance), 0);
  EXPECT_EQ(distance_to_out(ball.any(), Vec3{0, 0, 1}, along({0, 0, 1}), tolerance), 0);
  EXPECT_EQ(safety_to_in(ball.any(), Vec3{0, 0, 40}), 0);
  EXPECT_EQ(safety_to_out(ball.any(), Vec3{0, 0, 1}), 0);
  EXPECT_EQ(norm(normal(ball.any(), Vec3{0, 0, 1}, tolerance)), 1);
}

TEST(Foreign, RefusesWhatIsNoSolid) {
  const auto ball = std::make_shared<tests::Ball>(1);
  EXPECT_THROW(make_foreign("s", nullptr, {{-1, -1, -1}, {1, 1, 1}}), GeometryError);
  EXPECT_THROW(make_foreign("s", ball, {{1, -1, -1}, {-1, 1, 1}}), GeometryError);
  EXPECT_THROW(make_foreign("s", ball, {{-INFINITY, -1, -1}, {1, 1, 1}}), GeometryError);
}

TEST(Foreign, HasNoWiderForm) {
  EXPECT_THROW(widen<__float128>(tests::foreign_ball("s", 1)), GeometryError);
  const Solid cut = make_subtraction("cut", make_box("box", 2, 2, 2), tests::foreign_ball("s", 1));
  EXPECT_THROW(widen<__float128>(cut), GeometryError);
}

}  // namespace
}  // namespace navjit
