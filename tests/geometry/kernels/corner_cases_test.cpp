// Tips, tangents, seams and end faces: places where faces meet or directions decide.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/solids/solid.hpp"
#include "tests/geometry/kernels/random.hpp"

namespace navjit {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double tol = 1e-9;

using Planes = std::vector<ZPlane>;

struct Probe {
  kernels::AnySolid<double> solid;
  Vec3 p;
  Direction v;

  Probe(const Solid& s, const Vec3& point, double x, double y, double z)
      : solid(s.any()), p(point), v{} {
    const double norm = std::hypot(x, y, z);
    v = kernels::make_direction(x / norm, y / norm, z / norm);
  }
  Probe at(double t) const {
    Probe moved = *this;
    moved.p = kernels::advance(p, v, t);
    return moved;
  }
  bool in() const { return contains(solid, p, v, tol); }
  double to_in() const { return distance_to_in(solid, p, v, tol); }
  double to_out() const { return distance_to_out(solid, p, v, tol); }
};

TEST(Tips, OfConesLetInWhatStaysWithin) {
  const Solid cone = make_cone("c", 0, 0, 0, 1, 1, 0, turn);  // tip at z = -1, 2 high, 1 wide
  const Vec3 tip{0, 0, -1};
  EXPECT_TRUE(Probe(cone, tip, 0.1, 0, 1).in());
  EXPECT_EQ(Probe(cone, tip, 0.1, 0, 1).to_in(), 0);
  EXPECT_NEAR(Probe(cone, tip, 0.1, 0, 1).to_out(), 2 * std::hypot(0.1, 1), 1e-15);
  for (const Direction v :
       {kernels::make_direction(1.0, 0.0, 0.0), kernels::make_direction(0.8, 0.0, 0.6),
        kernels::make_direction(0.0, 0.0, -1.0)}) {
    EXPECT_FALSE(contains(cone.any(), tip, v, tol));
    EXPECT_EQ(distance_to_in(cone.any(), tip, v, tol), inf);
    EXPECT_EQ(distance_to_out(cone.any(), tip, v, tol), 0);
  }
  // From far below, exactly through the tip.
  for (const double slant : {0.0, 0.1, 0.3, 0.49}) {
    const Probe ray(cone, {-1000 * slant, 0, -1001}, slant, 0, 1);
    const double t = ray.to_in();
    EXPECT_NEAR(t, 1000 * std::hypot(slant, 1), 1e-11);
    EXPECT_TRUE(ray.at(t).in());
    EXPECT_NEAR(ray.at(t).to_out(), 2 * std::hypot(slant, 1), 1e-11);
  }
}

TEST(Tips, ARayBesideTheTipEntersWhereTheConeHasWidened) {
  // Less than the tolerance outside and heading outwards, but steeper than the cone.
  const Solid cone = make_cone("c", 0, 0, 0, 1, 1, 0, turn);
  const Probe ray(cone, {1e-6, 0, -1 + 2e-6}, 0.1, 0, 1);
  EXPECT_LT(ray.to_in(), 1e-5);
  const Probe within(cone, {5e-10, 0, -1}, 0.1, 0, 1);
  EXPECT_LT(within.to_in(), 1e-8);
  EXPECT_GT(within.at(within.to_in()).to_out(), 1.9);
}

TEST(Tips, OfPolarConesAreCrossedAtTheCentre) {
  const Solid upper = make_sphere("s", 0, 1, 0, turn, 0, std::numbers::pi / 4);
  const Probe through(upper, {0, 0, -2}, 0, 0, 1);
  EXPECT_EQ(through.to_in(), 2);
  EXPECT_EQ(through.at(2).to_out(), 1);
  const Solid lower = make_sphere("s", 0, 1, 0, turn, std::numbers::pi / 4, 4);
  const Probe down(lower, {0, 0, 2}, 0, 0, -1);
  EXPECT_EQ(down.to_in(), 2);
  EXPECT_EQ(down.at(2).to_out(), 1);
  EXPECT_EQ(Probe(lower, {0, 0, -0.5}, 0, 0, 1).to_out(), 0.5);
}

/// An end that is an edge has no width across it: its sides say nothing there but rounding.
TEST(Tips, OfArbsThatAreEdgesLetNothingInFarAway) {
  const PlanarPoint corners[8] = {{31, -7},     {-9, -26},    {-23, 12},    {8, 29},
                                  {21.7, -4.9}, {21.7, -4.9}, {-16.1, 8.4}, {-16.1, 8.4}};
  const Solid arb = make_arb8("a", 5.3, corners);
  test::Random random(1);
  for (int i = 0; i < test::scaled(50000); ++i) {
    const double end = random.chance(0.5) ? 5.3 : -5.3;
    const Vec3 p{random.uniform(-90, 90), random.uniform(-90, 90),
                 end + random.integer(-1, 1) * random.uniform(0, 2 * tol)};
    const PlanarPoint& to = corners[random.integer(0, 7)];
    const double towards_z = (random.chance(0.5) ? 1 : -1) * random.scale(1e-20, 1e-8);
    const Probe ray(arb, p, to.x - p.x, to.y - p.y, towards_z);
    if (ray.in()) continue;
    const double t = ray.to_in();
    ASSERT_TRUE(t < 300 || t == inf) << t << " mm from " << p.x << ' ' << p.y << ' ' << p.z;
  }
}

TEST(Axis, RaysAlongItPassHolesAndWedges) {
  const Solid tube = make_tube("t", 1, 2, 3, 0, turn);
  EXPECT_EQ(Probe(tube, {0, 0, -9}, 0, 0, 1).to_in(), inf);
  EXPECT_EQ(Probe(tube, {1.5, 0, -9}, 0, 0, 1).to_in(), 6);
  EXPECT_EQ(Probe(tube, {1.5, 0, -3}, 0, 0, 1).to_out(), 6);
  const Solid cone = make_cone("c", 0, 2, 0, 1, 3, 0, turn);
  EXPECT_EQ(Probe(cone, {0, 0, -9}, 0, 0, 1).to_in(), 6);
  EXPECT_EQ(Probe(cone, {0, 0, -3}, 0, 0, 1).to_out(), 6);
  const Solid quarter = make_tube("q", 0, 2, 3, 0, turn / 4);
  EXPECT_EQ(Probe(quarter, {-1, -1, 0}, 1, 1, 0).to_in(), std::sqrt(2.0));
  EXPECT_EQ(Probe(quarter, {1, 1, 0}, -1, -1, 0).to_out(), std::sqrt(2.0));
}

TEST(Tangents, LeaveRoundSurfacesAndSlideOnFlatOnes) {
  const Solid box = make_box("b", 1, 1, 1), orb = make_orb("o", 1);
  const Solid tube = make_tube("t", 0.5, 1, 1, 0, turn);
  const Vec3 side{1, 0, 0};
  EXPECT_TRUE(Probe(box, side, 0, 1, 0).in());
  EXPECT_EQ(Probe(box, side, 0, 1, 0).to_out(), 1);
  EXPECT_FALSE(Probe(orb, side, 0, 1, 0).in());
  EXPECT_EQ(Probe(orb, side, 0, 1, 0).to_in(), inf);
  EXPECT_FALSE(Probe(tube, side, 0, 1, 0).in());
  EXPECT_TRUE(Probe(tube, {0.5, 0, 0}, 0, 1, 0).in());
  EXPECT_NEAR(Probe(tube, {0.5, 0, 0}, 0, 1, 0).to_out(), std::sqrt(0.75), 1e-15);
}

TEST(Grazing, TheFaceJustEnteredIsNotTheExit) {
  const Solid box = make_box("b", 1, 1, 1), trd = make_trd("t", 1, 1, 1, 1, 1);
  const Solid tube = make_tube("u", 0, 1, 1, 0, turn);
  const Solid stack = make_polycone("p", Planes{{-1, 0, 1}, {0.25, 0, 1}, {1, 0, 1}}, 0, turn);
  for (const Solid& s : {box, trd, tube, stack}) {
    for (const double depth : {-3e-16, 0.0, 3e-16, 1e-12}) {
      const Probe ray(s, {0, 0, -1 + depth}, 1, 0, 1e-9);
      EXPECT_TRUE(ray.in()) << s.name;
      EXPECT_EQ(ray.to_in(), 0) << s.name;
      EXPECT_NEAR(ray.to_out(), 1, 1e-12) << s.name;
      const Probe out(s, {0, 0, 1 + depth}, 1, 0, 1e-9);
      EXPECT_FALSE(out.in()) << s.name;
      EXPECT_EQ(out.to_out(), 0) << s.name;
    }
  }
}

TEST(Grazing, ThinLayersAreNotJumpedOver) {
  // 2.4e-7 mm thick, crossed at a slope of 1e-9.
  const Solid layer = make_box("l", 1e4, 1e4, 1.2e-7);
  const Probe ray(layer, {0, 0, -1.2e-7}, 1, 0, 1e-9);
  EXPECT_EQ(ray.to_in(), 0);
  EXPECT_NEAR(ray.to_out(), 240, 1e-6);
}

TEST(Seams, BetweenSectionsAreNoSurface) {
  const Solid stack = make_polycone(
      "p", Planes{{-2, 0.5, 1}, {-1, 0.5, 1}, {0, 0.5, 1}, {0, 0.5, 2}, {1, 0.5, 2}, {2, 1, 1.5}},
      0, turn);
  EXPECT_EQ(inside(stack.any(), {0.75, 0, -1}, tol), Side::inside);
  EXPECT_EQ(inside(stack.any(), {0.75, 0, 0}, tol), Side::inside);
  EXPECT_EQ(inside(stack.any(), {1.5, 0, 0}, tol), Side::surface);
  EXPECT_EQ(Probe(stack, {0.75, 0, -2}, 0, 0, 1).to_out(), 3.5);
  EXPECT_EQ(Probe(stack, {0.75, 0, 1}, 0, 0, -1).to_out(), 3);
  EXPECT_EQ(Probe(stack, {1.25, 0, 1}, 0, 0, -1).to_out(), 1);
  EXPECT_EQ(Probe(stack, {1.25, 0, -3}, 0, 0, 1).to_in(), 3);
  // In the plane of a seam, and of a step.
  EXPECT_EQ(Probe(stack, {5, 0, -1}, -1, 0, 0).to_in(), 4);
  EXPECT_EQ(Probe(stack, {5, 0, 0}, -1, 0, 0).to_in(), 3);
  // From a grazing start within the tolerance of a seam.
  const Probe grazing(stack, {0.75, 0, -1 - 5e-10}, -1, 0, 1e-9);
  EXPECT_NEAR(grazing.to_out(), 0.25, 1e-12);
}

TEST(Seams, EndFacesSlideLikeThoseOfATube) {
  const Solid stack = make_polycone("p", Planes{{-1, 0, 1}, {0, 0, 1}, {1, 0, 1}}, 0, turn);
  const Solid tube = make_tube("t", 0, 1, 1, 0, turn);
  for (const Solid& s : {stack, tube}) {
    for (const double z : {-1.0, 0.0, 1.0}) {
      EXPECT_TRUE(Probe(s, {0, 0, z}, 1, 0, 0).in());
      EXPECT_EQ(Probe(s, {0, 0, z}, 1, 0, 0).to_out(), 1);
      EXPECT_EQ(Probe(s, {-3, 0, z}, 1, 0, 0).to_in(), 2);
    }
  }
}

TEST(Booleans, OperandsThatTouchAreOneSolid) {
  const Solid cube = make_box("b", 1, 1, 1);
  const Solid pair = make_union("u", cube, make_placed("m", cube, {{2, 0, 0}}));
  EXPECT_EQ(Probe(pair, {-5, 0, 0}, 1, 0, 0).to_in(), 4);
  EXPECT_EQ(Probe(pair, {-1, 0, 0}, 1, 0, 0).to_out(), 4);
  EXPECT_EQ(Probe(pair, {1, 0, 0}, 1, 0, 0).to_out(), 2);
  // Deep in one operand, the other's surface is no way in.
  EXPECT_EQ(Probe(pair, {0, 0, 0}, 1, 0, 0).to_in(), inf);
}

TEST(Booleans, ASubtractedFaceThatCoincidesLeavesNothingBehind) {
  const Solid cube = make_box("b", 1, 1, 1);
  const Solid half = make_subtraction("s", cube, make_placed("m", cube, {{1, 0, 0}}));
  EXPECT_EQ(Probe(half, {5, 0, 0}, -1, 0, 0).to_in(), 5);
  EXPECT_EQ(Probe(half, {-5, 0, 0}, 1, 0, 0).to_in(), 4);
  EXPECT_EQ(Probe(half, {-1, 0, 0}, 1, 0, 0).to_out(), 1);
  const Solid nothing = make_subtraction("n", cube, cube);
  EXPECT_EQ(Probe(nothing, {5, 0, 0}, -1, 0, 0).to_in(), inf);
}

}  // namespace
}  // namespace navjit
