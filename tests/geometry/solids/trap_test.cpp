// Traps with sides that are not quite planar get the mean planes of their sides, and these have
// their own corners.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/model/random.hpp"
#include "geometry/solids/any_solid.hpp"
#include "geometry/solids/make.hpp"

namespace navjit {
namespace {

constexpr double degree = 0.017453292519943295;

bool holds(const Extent& e, const Vec3& p, double slack) {
  return p.x >= e.min.x - slack && p.x <= e.max.x + slack && p.y >= e.min.y - slack &&
         p.y <= e.max.y + slack && p.z >= e.min.z - slack && p.z <= e.max.z + slack;
}

/// How many of some points near the box's corners are in the solid; all these must be in the box.
int check_corners(const Solid& solid, double far, std::mt19937_64& random) {
  const Extent& e = solid.extent;
  int within = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto near = [&](double low, double high) {
      return (uniform(random, 0, 1) < 0.5 ? low : high) + uniform(random, -far, far);
    };
    const Vec3 p{near(e.min.x, e.max.x), near(e.min.y, e.max.y), near(e.min.z, e.max.z)};
    if (inside(solid.any(), p, 0.0) == Side::outside) continue;
    ++within;
    EXPECT_TRUE(holds(e, p, 1e-12 * (1 + std::abs(p.x) + std::abs(p.y)))) << p.x << ' ' << p.y;
  }
  return within;
}

TEST(Trap, ItsBoxHoldsWhatItsMeanPlanesHold) {
  std::mt19937_64 random(11);
  // A triangle with one end a micrometre wider than the other: its sides are planes to 2e-5 mm.
  const Solid tip = make_trap("tip", 0.25, 0, 0, 57.875, 5.55, 0.00005, 2.74508 * degree, 57.875,
                              5.55, 0.0001, 2.74508 * degree);
  ASSERT_EQ(tip.kind, SolidKind::trap);
  EXPECT_GT(check_corners(tip, 3e-6, random), 100);
  int found = 0;
  for (int i = 0; i < 40; ++i) {
    const auto length = [&] { return uniform(random, 1, 50); };
    const double hx1 = length(), hx2 = length(), hy = length(), off = uniform(random, -4e-6, 4e-6);
    const double alpha = uniform(random, -0.6, 0.6);
    const Solid solid = make_trap("trap", length(), uniform(random, 0, 0.5), uniform(random, 0, 6),
                                  hy, hx1, hx2, alpha, hy, hx1, hx2 + off, alpha);
    if (solid.kind == SolidKind::trap) found += check_corners(solid, 1e-5, random) > 0;
  }
  EXPECT_GT(found, 10);
}

TEST(Trap, ARayThatGrazesBeyondItsCornersMeetsTheBox) {
  // It meets the mean plane of a side 6e-7 mm outside the box around the corners.
  const Solid tip = make_trap("tip", 0.25, 0, 0, 57.875, 5.55, 0.00005, 2.74508 * degree, 57.875,
                              5.55, 0.0001, 2.74508 * degree);
  const Vec3 p{-8.32495507, -57.2912877, 0.25};
  const Direction v = kernels::make_direction(-5.69367e-09, -1.0, 0.0);
  const double length = distance_to_in(tip.any(), p, v, 1e-9);
  ASSERT_TRUE(std::isfinite(length));
  EXPECT_TRUE(holds(tip.extent, {p.x + length * v.x, p.y + length * v.y, p.z}, 1e-9));
}

}  // namespace
}  // namespace navjit
