// Rays within a torus reach its surfaces by steps that are never too long; they end where the
// turning points of the distance from its circle say, and are nearly always used.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/solids/parts.hpp"
#include "geometry/solids/torus.hpp"
#include "tests/geometry/kernels/random.hpp"

namespace navjit::test {
namespace {

constexpr double tolerance = 1e-9;
constexpr double infinity = std::numeric_limits<double>::infinity();
using Torus = kernels::Torus<double>;

double exit_by_turning_points(const Torus& s, const Vec3& p, const Direction& v) {
  const kernels::RingForm<double> q{s.rtor, p, v};
  const auto turns = turns_ahead(q, s.rtor + s.rmax);
  const double leave = leave_body(ring_spans(s.rmax, q, turns, tolerance), infinity);
  return s.rmin > 0 ? leave_into_holes(ring_spans(s.rmin, q, turns, tolerance), leave) : leave;
}

/// The exit found without turning points, or a negative number.
double exit_by_steps(const Torus& s, const Vec3& p, const Direction& v) {
  const kernels::RingForm<double> q{s.rtor, p, v};
  const double hole = s.rtor - s.rmax, leave = ring_exit(s.rmax, hole, q, tolerance);
  if (!(leave > 0) || s.rmin == 0) return leave;
  const double enter = ring_entry(s.rmin, hole, q, tolerance, leave);
  return enter > 0 ? std::min(leave, enter) : -1;
}

Torus random_torus(Random& random) {
  const double rtor = random.scale(1, 1000), rmax = rtor * random.scale(1e-3, 0.99);
  const double rmin = random.chance(0.5) ? 0 : rmax * random.uniform(0.1, 0.99);
  return {rmin, rmax, rtor, {}};
}

struct Ray {
  Vec3 p;
  Direction v;
};

/// A ray that starts between the surfaces.
Ray ray_within(Random& random, const Torus& s) {
  const double phi = random.uniform(0, 2 * std::numbers::pi);
  const double psi = random.uniform(0, 2 * std::numbers::pi);
  const double r = random.uniform(s.rmin, s.rmax), rho = s.rtor + r * std::cos(psi);
  return {{rho * std::cos(phi), rho * std::sin(phi), r * std::sin(psi)}, random.any_direction()};
}

TEST(TorusExit, IsWhereTheTurningPointsSayAndNearlyAlwaysFoundWithoutThem) {
  Random random(43);
  int found = 0, all = 0, into_hole = 0;
  for (int n = 0; n < scaled(100000); ++n) {
    const Torus s = random_torus(random);
    Ray ray = ray_within(random, s);
    // Half of them start on a surface.
    if (random.chance(0.5)) {
      const double back =
          exit_by_turning_points(s, ray.p, kernels::make_direction(-ray.v.x, -ray.v.y, -ray.v.z));
      ray.p = advance(ray.p, ray.v, -back);
    }
    if (!contains(s, ray.p, ray.v, tolerance)) continue;
    ++all;
    const double expected = exit_by_turning_points(s, ray.p, ray.v);
    EXPECT_NEAR(distance_to_out(s, ray.p, ray.v, tolerance), expected, 1e-12 * s.rtor + 1e-14);
    const double t = exit_by_steps(s, ray.p, ray.v);
    if (!(t > 0)) continue;
    ++found;
    const Vec3 at = advance(ray.p, ray.v, t);
    into_hole += ring_distance(s.rtor, at) < (s.rmin + s.rmax) / 2;
  }
  EXPECT_GT(all, scaled(100000) * 9 / 10);
  EXPECT_GT(found, all * 0.97);
  EXPECT_GT(into_hole, all / 10);
}

TEST(TorusExit, OfWhatGrazesIsLeftToTheTurningPoints) {
  const Torus s{0, 5, 100, {}};
  const auto along = kernels::make_direction(0.0, 1.0, 0.0);
  // A tangent at the inner side of the ring, a hundredth of the tolerance deep; and half of rmax.
  const auto exit = [&](double depth) {
    const kernels::RingForm<double> q{s.rtor, {95 + depth, 0, 0}, along};
    return ring_exit(s.rmax, s.rtor - s.rmax, q, tolerance);
  };
  EXPECT_LT(exit(0.01 * tolerance), 0);
  EXPECT_GT(exit(2.5), 0);
  // Nor is anything found without turning points where there is no hole.
  const kernels::RingForm<double> q{5, {5, 0, 0}, along};
  EXPECT_LT(ring_exit(5.0, 0.0, q, tolerance), 0);
}

TEST(TorusExit, ByAnInnerTubeThatIsMissedOrTouchedIsTheOuterOne) {
  const auto along = kernels::make_direction(0.0, 0.0, 1.0);
  const auto entry = [&](double rho) {
    const kernels::RingForm<double> q{100, {rho, 0, -9}, along};
    return ring_entry(4.0, 90.0, q, tolerance, 18.0);
  };
  EXPECT_EQ(entry(104.5), infinity);
  EXPECT_NEAR(entry(103), 9 - std::sqrt(7.0), 1e-12);
  // Tangents, and what is narrow, are for the turning points to judge.
  EXPECT_LT(entry(104), 0);
  EXPECT_LT(entry(104 - 1e-3 * tolerance), 0);
  const kernels::RingForm<double> through{100, {100, 0, -9}, along};
  EXPECT_LT(ring_entry(1e-8, 90.0, through, tolerance, 18.0), 0);
  // From its surface outwards it is not entered.
  const kernels::RingForm<double> q{100, {104, 0, 0}, kernels::make_direction(1.0, 0.0, 0.0)};
  EXPECT_EQ(ring_entry(4.0, 90.0, q, tolerance, 6.0), infinity);
}

}  // namespace
}  // namespace navjit::test
