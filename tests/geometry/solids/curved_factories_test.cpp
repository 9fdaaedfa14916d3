// What the makers of tori, quadrics and twisted solids accept and refuse, and the conventions of
// their dimensions.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/solids/solid.hpp"

namespace navjit {
namespace {

constexpr double pi = std::numbers::pi, turn = 2 * pi;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Side where(const Solid& s, double x, double y, double z) {
  return inside(s.any(), Vec3{x, y, z}, 1e-9);
}

TEST(CurvedFactories, RefuseDimensionsThatMakeNoSolid) {
  EXPECT_THROW(make_torus("s", 0, 2, 0, 0, turn), GeometryError);
  EXPECT_THROW(make_torus("s", 2, 2, 5, 0, turn), GeometryError);
  EXPECT_THROW(make_torus("s", -1, 2, 5, 0, turn), GeometryError);
  EXPECT_THROW(make_torus("s", 0, 2, 5, 0, 0), GeometryError);
  EXPECT_THROW(make_torus("s", 0, nan, 5, 0, turn), GeometryError);
  EXPECT_THROW(make_ellipsoid("s", 1, 0, 1, 0, 0), GeometryError);
  EXPECT_THROW(make_ellipsoid("s", 1, 1, 1, 0.5, 0.5), GeometryError);
  EXPECT_THROW(make_ellipsoid("s", 1, 1, 1, 1, 2), GeometryError);
  EXPECT_THROW(make_ellipsoid("s", 1, 1, 1, -2, -1), GeometryError);
  EXPECT_THROW(make_eltube("s", 1, -1, 1), GeometryError);
  // The squares of such lengths have no reciprocals, and the equation would hold everything.
  EXPECT_THROW(make_ellipsoid("s", 1e-160, 50, 40, 0, 0), GeometryError);
  EXPECT_THROW(make_ellipsoid("s", 1e200, 50, 40, 0, 0), GeometryError);
  EXPECT_THROW(make_eltube("s", 1e-170, 50, 40), GeometryError);
  EXPECT_THROW(make_elcone("s", 1e-170, 1, 50, 40), GeometryError);
  // Steps in them would be as short as they are thin.
  EXPECT_THROW(make_twistedbox("s", 0.5, 1e-20, 40, 50), GeometryError);
  EXPECT_NO_THROW(make_twistedbox("s", 0.5, 1e-6, 40, 50));
  EXPECT_THROW(make_elcone("s", 1, 1, 1, 0), GeometryError);
  EXPECT_THROW(make_elcone("s", 0, 1, 1, 1), GeometryError);
  EXPECT_THROW(make_paraboloid("s", 1, 1, 1), GeometryError);
  EXPECT_THROW(make_paraboloid("s", -1, 1, 1), GeometryError);
  EXPECT_THROW(make_paraboloid("s", 0, 1, 0), GeometryError);
  EXPECT_THROW(make_hype("s", 1, 1, 0, 0, 1), GeometryError);
  EXPECT_THROW(make_hype("s", 1, 2, 1.5, 0, 1), GeometryError);
  EXPECT_THROW(make_hype("s", 0, 1, 0, 0, 0), GeometryError);
  EXPECT_THROW(make_twistedbox("s", 0, 1, 1, 1), GeometryError);
  EXPECT_THROW(make_twistedbox("s", pi / 2, 1, 1, 1), GeometryError);
  EXPECT_THROW(make_twistedtrd("s", 1, 0, 1, 1, 1, 1), GeometryError);
  EXPECT_THROW(make_twistedtrap("s", 1, 1, pi / 2, 0, 1, 1, 1, 1, 1, 1, 0), GeometryError);
  EXPECT_THROW(make_twistedtubs("s", 1, 0, 1, -1, 1, 1), GeometryError);
  EXPECT_THROW(make_twistedtubs("s", 1, 1, 2, 1, 1, 1), GeometryError);
  EXPECT_THROW(make_twistedtubs("s", 1, 1, 2, -1, 1, 4), GeometryError);
  EXPECT_THROW(make_twistedtubs("s", 4, 1, 2, -1, 1, 1), GeometryError);
}

TEST(CurvedFactories, CutEllipsoids) {
  const Solid whole = make_ellipsoid("s", 1, 2, 3, 0, 0);
  EXPECT_EQ(where(whole, 0, 0, 3), Side::surface);
  EXPECT_EQ(whole.extent.max.z, 3);
  const Solid cap = make_ellipsoid("s", 5, 10, 5, 3, 9);
  EXPECT_EQ(cap.extent.min.z, 3);
  EXPECT_EQ(cap.extent.max.z, 5);
  EXPECT_NEAR(cap.extent.max.x, 4, 1e-15);
  EXPECT_NEAR(cap.extent.max.y, 8, 1e-14);
  EXPECT_EQ(where(cap, 0, 0, 3), Side::surface);
  EXPECT_EQ(where(cap, 0, 0, 2.9), Side::outside);
}

TEST(CurvedFactories, LetAnEllipticalConeEndInItsTip) {
  const Solid cone = make_elcone("s", 0.5, 1, 2, 7);
  EXPECT_EQ(cone.extent.max.z, 2);
  EXPECT_EQ(cone.extent.max.x, 2);
  EXPECT_EQ(cone.extent.max.y, 4);
  EXPECT_EQ(where(cone, 0, 0, 2), Side::surface);
  EXPECT_EQ(where(cone, 0, 0, 1.99), Side::inside);
  EXPECT_EQ(where(cone, 1, 0, 0), Side::surface);
  EXPECT_EQ(where(cone, 0, 0, 2.1), Side::outside);
}

TEST(CurvedFactories, WidenHyperbolicTubesTowardsTheirEnds) {
  const Solid tube = make_hype("s", 1, 2, std::atan(0.5), std::atan(1.0), 2);
  EXPECT_EQ(where(tube, 1, 0, 0), Side::surface);
  EXPECT_EQ(where(tube, std::sqrt(2.0), 0, 2), Side::surface);
  EXPECT_EQ(where(tube, std::sqrt(8.0), 0, 2), Side::surface);
  EXPECT_EQ(where(tube, 1.3, 0, 1.9), Side::outside);
  EXPECT_EQ(where(tube, 2.5, 0, 1.9), Side::inside);
}

TEST(CurvedFactories, TurnTwistedSolidsWithZ) {
  const Solid box = make_twistedbox("s", 1, 3, 1, 2);
  for (const double z : {-2.0, -1.0, 0.0, 1.5, 2.0}) {
    const double angle = z / 4;
    const auto at = [&](double u, double w) {
      return where(box, u * std::cos(angle) - w * std::sin(angle),
                   u * std::sin(angle) + w * std::cos(angle), z);
    };
    EXPECT_EQ(at(3, 0.5), Side::surface);
    EXPECT_EQ(at(3, -1), Side::surface);
    EXPECT_EQ(at(2.9, 1), Side::surface);
    EXPECT_EQ(at(2.9, 1.1), Side::outside);
  }
  // The rulings of a twisted tube are straight lines.
  const Solid tube = make_twistedtubs("s", 1.2, 1, 2, -3, 3, 1);
  const double tangent = std::tan(0.6), c = std::cos(0.5), s = std::sin(0.5);
  for (const double part : {-1.0, -0.3, 0.6, 1.0}) {
    const double w = 2 * tangent * part;
    EXPECT_EQ(where(tube, 2 * c - w * s, 2 * s + w * c, 3 * part), Side::surface);
  }
}

}  // namespace
}  // namespace navjit
