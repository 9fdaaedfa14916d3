// Tori and curved solids where rays touch, slide and just miss.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <sstream>

#include "geometry/solids/solid.hpp"

namespace navjit {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double tol = 1e-9;

double to_in(const Solid& s, const Vec3& p, double x, double y, double z) {
  const double n = std::hypot(x, y, z);
  return distance_to_in(s.any(), p, kernels::make_direction(x / n, y / n, z / n), tol);
}
double to_out(const Solid& s, const Vec3& p, double x, double y, double z) {
  const double n = std::hypot(x, y, z);
  return distance_to_out(s.any(), p, kernels::make_direction(x / n, y / n, z / n), tol);
}
bool in(const Solid& s, const Vec3& p, double x, double y, double z) {
  const double n = std::hypot(x, y, z);
  return contains(s.any(), p, kernels::make_direction(x / n, y / n, z / n), tol);
}

TEST(SphereRays, AlongAPolarLimitDoNotMeetTheOtherNappe) {
  // From the bore, where only the other half of the line through the centre is ahead.
  for (int i = 1; i < 150; ++i) {
    const double theta = 0.01 * i;
    const Solid cap = make_sphere("cap", 10, 20, 0, turn, 0, theta);
    const double x = std::sin(theta), z = std::cos(theta);
    for (const double phi : {0.0, 1.0, 4.0}) {
      const Vec3 along{x * std::cos(phi), x * std::sin(phi), z};
      const Vec3 p = 75 * along - 65.5 * along;
      EXPECT_EQ(to_in(cap, p, -along.x, -along.y, -along.z), inf) << theta;
      // From the other side only the true half is met, somewhere on the limit, or it is passed.
      const double t = to_in(cap, -75 * along, along.x, along.y, along.z);
      EXPECT_TRUE(t == inf || (t > 85 - 1e-6 && t < 95 + 1e-6)) << theta << ' ' << t;
      const Solid full = make_sphere("full", 0, 20, 0, turn, 0, theta);
      const double to_tip = to_in(full, -75 * along, along.x, along.y, along.z);
      EXPECT_GE(to_tip, 75 - 1e-6) << theta;
    }
  }
}

TEST(TwistedRays, ThatTouchASideNeitherStickNorVanish) {
  for (const double twist : {1e-9, 1e-7, 1e-5, 1e-3, 0.1, 1.0}) {
    const Solid box = make_twistedbox("box", twist, 10, 10, 20);
    std::minstd_rand random(1);
    const auto number = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random()) / 2147483647.0;
    };
    for (int i = 0; i < 2000; ++i) {
      // On the side x = 10 of the section at this z, along its tangents.
      const double z = number(-19, 19), y = number(-9, 9), angle = twist * z / 40;
      const double c = std::cos(angle), s = std::sin(angle);
      const Vec3 p{10 * c - y * s, 10 * s + y * c, z};
      // The side's direction along z is that of its points at this y.
      const double turning = twist / 40;
      const Vec3 up{-turning * p.y, turning * p.x, 1}, side{-s, c, 0};
      const double share = number(-1, 1);
      Vec3 v = share * up + (1 - std::abs(share)) * side;
      v = (1 / norm(v)) * v;
      Vec3 at = p;
      bool inside = in(box, at, v.x, v.y, v.z);
      int steps = 0;
      for (; steps < 20; ++steps) {
        const double t = inside ? to_out(box, at, v.x, v.y, v.z) : to_in(box, at, v.x, v.y, v.z);
        ASSERT_GE(t, 0);
        if (t == inf) break;
        at += t * v;
        inside = !inside;
      }
      ASSERT_LT(steps, 20) << twist << ' ' << i;
    }
  }
}

TEST(TorusRays, CrossTheTubeUpToFourTimes) {
  const Solid torus = make_torus("t", 0, 1, 5, 0, turn);
  EXPECT_DOUBLE_EQ(to_in(torus, {-10, 0, 0}, 1, 0, 0), 4);
  EXPECT_DOUBLE_EQ(to_out(torus, {-6, 0, 0}, 1, 0, 0), 2);
  EXPECT_DOUBLE_EQ(to_in(torus, {-4, 0, 0}, 1, 0, 0), 8);
  EXPECT_DOUBLE_EQ(to_out(torus, {4, 0, 0}, 1, 0, 0), 2);
  EXPECT_EQ(to_in(torus, {6, 0, 0}, 1, 0, 0), inf);
  EXPECT_EQ(to_in(torus, {0, 0, -10}, 0, 0, 1), inf);
  EXPECT_DOUBLE_EQ(to_in(torus, {5, 0, -10}, 0, 0, 1), 9);
  EXPECT_DOUBLE_EQ(to_out(torus, {5, 0, -1}, 0, 0, 1), 2);
}

TEST(TorusRays, StartOnTheAxis) {
  const Solid torus = make_torus("t", 0, 20, 100, 0, turn);
  // (x - 100)^2 + (10 + x / 20)^2 = 20^2 along the ray.
  const double x = (199 - std::sqrt(199.0 * 199 - 4 * 1.0025 * 9700)) / (2 * 1.0025);
  EXPECT_NEAR(to_in(torus, {0, 0, 10}, 1, 0, 0.05), x * std::sqrt(1.0025), 1e-12);
  EXPECT_NEAR(to_in(torus, {0, 0, -10}, 0, -1, -0.05), x * std::sqrt(1.0025), 1e-12);
  EXPECT_EQ(to_in(torus, {0, 0, 10}, 1, 0, 1), inf);
}

TEST(TorusRays, GoStraightOnThroughAHoleNarrowerThanTheTolerance) {
  // The hole is a point, or 7e-15 mm wide.
  for (const double rtor : {7.0, 7 * (1 + 1e-15)}) {
    const Solid torus = make_torus("t", 0, 7, rtor, 0, turn);
    for (const double off : {0.0, 5e-324, 1e-310, 1e-200, 1e-100, 1e-30, 1e-12}) {
      for (const double along : {0.0, 5e-324, 1e-322, 1e-12}) {
        for (const Vec3& v : {Vec3{1, 0, 0}, Vec3{1, 5e-324, -1e-320}, Vec3{0.6, 0, 0.8},
                              Vec3{-0.48, 0.64, 0.6}, Vec3{1, 1e-200, 0}, Vec3{0.7, 0.1, -1e-9}}) {
          for (const Vec3& p :
               {Vec3{along, off, 0}, Vec3{-along, 0, off}, Vec3{off, -along, -off}}) {
            const double s = std::hypot(v.x, v.y) / std::hypot(v.x, v.y, v.z);
            const auto where = [&] {
              std::ostringstream text;
              text << p.x << ' ' << p.y << ' ' << p.z << " along " << v.x << ' ' << v.y << ' '
                   << v.z;
              return text.str();
            };
            EXPECT_TRUE(in(torus, p, v.x, v.y, v.z)) << where();
            EXPECT_NEAR(to_out(torus, p, v.x, v.y, v.z), 14 * s, 1e-6) << where();
          }
        }
      }
    }
    EXPECT_NEAR(to_out(torus, {-14, 0, 0}, 1, 0, 0), 28, 1e-12);
    // A wider hole is one, and so is a narrow one along the axis.
    EXPECT_NEAR(to_out(make_torus("t", 0, 7, 7.001, 0, turn), {-14, 0, 0}, 1, 0, 0), 13.999, 1e-9);
    EXPECT_EQ(to_in(torus, {0, 0, 9}, 0, 0, -1), inf);
  }
}

TEST(TorusRays, ThatIsWiderThanItsCircle) {
  // The axis is in it up to z = 4; above are dimples down to there.
  const Solid torus = make_torus("t", 0, 5, 3, 0, turn);
  EXPECT_EQ(to_out(torus, {0, 0, 0}, 0, 0, 1), 4);
  EXPECT_EQ(to_in(torus, {0, 0, 9}, 0, 0, -1), 5);
  EXPECT_DOUBLE_EQ(to_out(torus, {0, 0, 0}, 1, 0, 0), 8);
  EXPECT_DOUBLE_EQ(to_out(torus, {-8, 0, 0}, 1, 0, 0), 16);
  const double rim = 3 + std::sqrt(25 - 4.5 * 4.5), lip = 6 - rim;
  EXPECT_NEAR(to_in(torus, {-20, 0, 4.5}, 1, 0, 0), 20 - rim, 1e-12);
  EXPECT_NEAR(to_out(torus, {-3, 0, 4.5}, 1, 0, 0), 3 - lip, 1e-12);
  EXPECT_NEAR(to_in(torus, {0, 0, 4.5}, 1, 0, 0), lip, 1e-12);
}

TEST(TorusRays, HollowTubesAreCrossedTwiceAsOften) {
  const Solid torus = make_torus("t", 0.5, 1, 5, 0, turn);
  double x = -10;
  for (const double step : {4.0, 0.5, 1.0, 0.5, 8.0, 0.5, 1.0, 0.5}) {
    const Vec3 p{x, 0, 0};
    EXPECT_NEAR(in(torus, p, 1, 0, 0) ? to_out(torus, p, 1, 0, 0) : to_in(torus, p, 1, 0, 0), step,
                1e-14);
    x += step;
  }
  EXPECT_EQ(to_in(torus, {x, 0, 0}, 1, 0, 0), inf);
}

TEST(TorusRays, TangentsGoWhereTheSurfaceBends) {
  const Solid torus = make_torus("t", 0, 1, 5, 0, turn);
  // Around the hole, into the torus; across the hole's narrowest place, out of it.
  EXPECT_TRUE(in(torus, {4, 0, 0}, 0, 1, 0));
  EXPECT_EQ(to_in(torus, {4, 0, 0}, 0, 1, 0), 0);
  EXPECT_NEAR(to_out(torus, {4, 0, 0}, 0, 1, 0), std::sqrt(20.0), 1e-14);
  EXPECT_FALSE(in(torus, {4, 0, 0}, 0, 0, 1));
  EXPECT_EQ(to_in(torus, {4, 0, 0}, 0, 0, 1), inf);
  EXPECT_FALSE(in(torus, {6, 0, 0}, 0, 1, 0));
  EXPECT_EQ(to_in(torus, {6, -9, 0}, 0, 1, 0), inf);
  // A ray through the hole that touches its narrowest place on both sides of the tangent.
  EXPECT_NEAR(to_in(torus, {4 - 1e-6, -9, 0}, 0, 1, 0), 9 - std::sqrt(36 - 16.0), 1e-5);
  EXPECT_NEAR(to_out(torus, {4 + 1e-6, 0, 0}, 0, 1, 0), std::sqrt(20.0), 1e-5);
  // The plane on top touches along a circle.
  EXPECT_EQ(to_in(torus, {-9, 0, 1 + 1e-12}, 1, 0, 0), inf);
  EXPECT_NEAR(to_in(torus, {-9, 0, 1 - 1e-6}, 1, 0, 0), 4 - std::sqrt(2e-6), 1e-8);
}

TEST(TorusRays, ThinRingsAndClosedHolesAreResolved) {
  const Solid ring = make_torus("r", 0, 1e-3, 1e3, 0, turn);
  EXPECT_NEAR(to_in(ring, {-2e3, 0, 0}, 1, 0, 0), 1e3 - 1e-3, 1e-12);
  EXPECT_NEAR(to_out(ring, {-1e3 - 1e-3, 0, 0}, 1, 0, 0), 2e-3, 1e-12);
  EXPECT_NEAR(to_in(ring, {-999, 0, 0}, 1, 0, 0), 1999 - 1e-3, 1e-11);
  EXPECT_NEAR(to_in(ring, {1e3, 1, -5}, 0, -0.2, 1), 5 * std::hypot(1, 0.2), 0.01);
  const Solid closed = make_torus("c", 0, 1, 1 + 1e-6, 0, turn);
  EXPECT_EQ(to_in(closed, {0, 0, -3}, 0, 0, 1), inf);
  EXPECT_NEAR(to_in(closed, {1e-3, 0, -3}, 0, 0, 1), 3 - std::sqrt(2 * 0.999e-3), 1e-4);
  EXPECT_NEAR(to_out(closed, {1.0, 0, 0}, -1, 0, 0), 1 - 1e-6, 1e-12);
}

TEST(CylinderRays, NearlyAlongTheAxisDoNotEnterByLessThanTheTolerance) {
  // On the surface, and inwards by rounding alone: once entered, it left after 2e-5 mm, for ever.
  const Solid tube = make_tube("t", 0, 2600, 3500, 0, turn);
  const Vec3 p{-1838.4776310850234, 1838.4776310850236, -3345};
  const double slope = 5.18e-9;
  EXPECT_FALSE(in(tube, p, -slope, -slope, 1));
  EXPECT_EQ(to_out(tube, p, -slope, -slope, 1), 0);
  EXPECT_EQ(to_in(tube, p, -slope, -slope, 1), inf);
  EXPECT_TRUE(in(tube, p, slope, -slope, 1));
}

TEST(QuadricRays, GoOnceThroughWhatIsCutAtATip) {
  const Solid cone = make_elcone("c", 1, 1, 1, 1);
  EXPECT_EQ(to_in(cone, {0, 0, 5}, 0, 0, -1), 4);
  EXPECT_EQ(to_out(cone, {0, 0, 1}, 0, 0, -1), 2);
  EXPECT_EQ(to_in(cone, {-3, 0, 1.5}, 1, 0, 0), inf);
  const Solid bowl = make_paraboloid("p", 0, 2, 1);
  EXPECT_EQ(to_in(bowl, {0, 0, -5}, 0, 0, 1), 4);
  EXPECT_EQ(to_out(bowl, {0, 0, -1}, 0, 0, 1), 2);
  EXPECT_FALSE(in(bowl, {0, 0, -1}, 1, 0, 0));
}

TEST(QuadricRays, MeetTheWaistOfAHyperboloidTwice) {
  const Solid tube = make_hype("h", 0, 1, 0, std::numbers::pi / 4, 4);
  // Beside the waist, parallel to the axis: in at both ends, out between.
  const double z = std::sqrt(3.0);
  EXPECT_NEAR(to_in(tube, {2, 0, -9}, 0, 0, 1), 5, 1e-15);
  EXPECT_NEAR(to_out(tube, {2, 0, -4}, 0, 0, 1), 4 - z, 1e-15);
  EXPECT_NEAR(to_in(tube, {2, 0, 0}, 0, 0, 1), z, 1e-15);
  EXPECT_NEAR(to_out(tube, {2, 0, z}, 0, 0, 1), 4 - z, 1e-15);
}

}  // namespace
}  // namespace navjit
