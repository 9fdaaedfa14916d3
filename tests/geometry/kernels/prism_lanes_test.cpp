// Eight edges of a polygon asked at once answer as one after the other.
#include <gtest/gtest.h>

#include <bit>

#include "tests/geometry/kernels/random_solids.hpp"

namespace navjit::test {
namespace {

using Prism = kernels::Prism<double>;

/// A star of so many corners, as the outline of an upright prism.
Solid star(Random& random, int corners) {
  std::vector<navjit::PlanarPoint> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners, r = random.uniform(2, 6);
    outline.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return make_extruded("star", outline, std::vector<ExtrudedSection>{{-1, 0, 0, 1}, {1, 0, 0, 1}});
}

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

TEST(EightEdges, AreCrossedWhereEachIs) {
  Random random(23);
  int prisms = 0, crossed = 0, through_corners = 0;
  for (int n = 0; n < scaled(2000); ++n) {
    const Solid solid = star(random, random.integer(4, kernels::most_corners_of_prism));
    if (solid.kind != SolidKind::prism) continue;
    ++prisms;
    const auto& s = *static_cast<const Prism*>(solid.any().shape);
    for (int i = 0; i < 20; ++i) {
      const kernels::PlanarCorner<double>& at = s.corners[random.integer(0, s.count - 1)];
      const double angle = random.uniform(0, 6.2);
      kernels::PlanarRay<double> ray{random.uniform(-8, 8), random.uniform(-8, 8), std::cos(angle),
                                     std::sin(angle), false};
      if (random.chance(0.3)) {  // through a corner, or nearly, or from it
        const double back = random.chance(0.3) ? 0 : random.uniform(-2, 2);
        ray.x = at.x - back * ray.u;
        ray.y = at.y - back * ray.v;
        ++through_corners;
      }
      const double tolerance = random.chance(0.5) ? 1e-9 : 0, close = random.chance(0.5) ? 1e-9 : 0;
      auto at_once = kernels::edges_ahead<kernels::Keep::all>(s, ray, tolerance, close);
      auto one_by_one = kernels::edges_ahead<kernels::Keep::all, double>(s, ray, tolerance, close);
      ASSERT_EQ(at_once.total, one_by_one.total);
      ASSERT_EQ(at_once.near >= 2, one_by_one.near >= 2 || at_once.near > one_by_one.near);
      for (int k = 0; k < s.count; ++k) {
        ASSERT_EQ(bits(at_once.t[k]), bits(one_by_one.t[k])) << k;
        ASSERT_EQ(at_once.out[k / 64] >> k % 64 & 1, one_by_one.out[k / 64] >> k % 64 & 1);
        crossed += at_once.t[k] < INFINITY ? 1 : 0;
      }
      for (;;) {
        const auto next = take_nearest(at_once), same = kernels::take_nearest<double>(one_by_one);
        ASSERT_EQ(bits(next.t), bits(same.t));
        ASSERT_EQ(next.turn, same.turn);
        if (!(next.t < INFINITY)) break;
      }
    }
  }
  EXPECT_GT(prisms, scaled(1500));
  EXPECT_GT(crossed, scaled(30000));
  EXPECT_GT(through_corners, scaled(5000));
}

TEST(EightEdges, AreAsFarAsTheNearestOfThem) {
  Random random(29);
  for (int n = 0; n < scaled(2000); ++n) {
    const Solid solid = star(random, random.integer(4, kernels::most_corners_of_prism));
    if (solid.kind != SolidKind::prism) continue;
    const auto& s = *static_cast<const Prism*>(solid.any().shape);
    for (int i = 0; i < 20; ++i) {
      const double x = random.uniform(-8, 8), y = random.uniform(-8, 8);
      ASSERT_EQ(bits(kernels::edges_distance2(s, x, y)),
                bits(kernels::edges_distance2<double>(s, x, y)));
    }
  }
}

}  // namespace
}  // namespace navjit::test
