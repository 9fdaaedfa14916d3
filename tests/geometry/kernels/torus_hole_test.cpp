// Rays through the hole of a torus are known without turning points: only those, and nearly all.
#include <gtest/gtest.h>

#include <algorithm>
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

kernels::Torus<double> ring(double rmax, double rtor) { return {0, rmax, rtor, {}}; }

bool told(const kernels::Torus<double>& s, const Vec3& p, const Direction& v) {
  return passes_through_hole(s, {s.rtor, p, v}, tolerance);
}

/// The least distance of the ray, from its start on, to the circle in the middle of the tube.
/// Around the planes that bound the tube, the ray is cut into many pieces.
double nearest_to_ring(const kernels::Torus<double>& s, const Vec3& p, const Direction& v) {
  const double far = 4 * (s.rtor + s.rmax) + std::abs(p.x) + std::abs(p.y) + std::abs(p.z);
  double from = 0, to = far;
  if (v.z != 0) {
    const double one = (-2 * s.rmax - p.z) / v.z, other = (2 * s.rmax - p.z) / v.z;
    from = std::clamp(std::min(one, other), 0.0, far);
    to = std::clamp(std::max(one, other), 0.0, far);
  }
  constexpr int pieces = 2000;
  double least = infinity;
  for (int i = 0; i <= pieces; ++i) {
    const double t = from + (to - from) * i / pieces;
    least = std::min(least, ring_distance(s.rtor, advance(p, v, t)));
  }
  return least;
}

TEST(TorusHole, IsPassedByRaysThatMissTheTorusAlone) {
  Random random(41);
  int through = 0;
  for (int n = 0; n < scaled(3000); ++n) {
    const double rtor = random.scale(1, 1000);
    const auto s = ring(rtor * random.scale(1e-4, 0.9), rtor);
    const double reach = 1.5 * (s.rtor + s.rmax);
    const Vec3 p{random.uniform(-reach, reach), random.uniform(-reach, reach),
                 random.uniform(-3 * s.rmax, 3 * s.rmax)};
    const Direction v = random.any_direction();
    if (!told(s, p, v)) continue;
    ++through;
    EXPECT_GT(nearest_to_ring(s, p, v), s.rmax) << "ray " << n;
    EXPECT_EQ(distance_to_in(s, p, v, tolerance), infinity);
  }
  EXPECT_GT(through, scaled(3000) / 10);
}

TEST(TorusHole, OfAThinRingIsPassedByMostRaysThatCrossItsDisc) {
  Random random(42);
  const auto s = ring(3, 680);
  int told_of = 0, crossing = 0;
  for (int n = 0; n < scaled(3000); ++n) {
    const double r = 680 * std::sqrt(random.uniform(0, 1));
    const double phi = random.uniform(0, 2 * std::numbers::pi);
    const Direction v = random.direction();
    const Vec3 p = advance(Vec3{r * std::cos(phi), r * std::sin(phi), 0}, v, -2000.0);
    ++crossing;
    told_of += told(s, p, v) ? 1 : 0;
  }
  EXPECT_GT(told_of, crossing * 9 / 10);
}

TEST(TorusHole, IsNotPassedByWhatTouchesOrStartsInTheTorus) {
  const auto s = ring(3, 680);
  const double inner = 677;
  for (const double r : {inner, inner - 1e-12, inner + 1e-12, 680.0, 683.0}) {
    EXPECT_FALSE(told(s, {r, 0, -10}, kernels::make_direction(0.0, 0.0, 1.0))) << r;
    EXPECT_FALSE(told(s, {r, 0, 0}, kernels::make_direction(0.0, 0.0, 1.0))) << r;
    EXPECT_FALSE(told(s, {r, 0, 0}, kernels::make_direction(-1.0, 0.0, 0.0))) << r;
  }
  // Along the disc the ray comes to the ring sooner or later; above it, never.
  EXPECT_FALSE(told(s, {0, 0, 1}, kernels::make_direction(1.0, 0.0, 0.0)));
  EXPECT_TRUE(told(s, {0, 0, 4}, kernels::make_direction(1.0, 0.0, 0.0)));
  // What has no hole has none to pass.
  EXPECT_FALSE(told(ring(5, 5), {0, 0, -10}, kernels::make_direction(0.0, 0.0, 1.0)));
  EXPECT_FALSE(told(ring(9, 5), {0, 0, -10}, kernels::make_direction(0.0, 0.0, 1.0)));
}

}  // namespace
}  // namespace navjit::test
