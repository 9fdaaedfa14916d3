// Eight corners or edges of a polygon at once answer as one after the other.
#include <gtest/gtest.h>

#include <bit>

#include "tests/geometry/kernels/random_solids.hpp"

namespace navjit::test {
namespace {

using Prism = kernels::Prism<double>;

/// A star of as many corners, which an upright prism has for its outline.
Solid star(Random& random, int corners) {
  std::vector<navjit::PlanarPoint> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners, r = random.uniform(2, 6);
    outline.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return make_extruded("star", outline, std::vector<ExtrudedSection>{{-1, 0, 0, 1}, {1, 0, 0, 1}});
}

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

TEST(EightCorners, AreOnTheSidesThatEachIsOn) {
  Random random(23);
  int prisms = 0, near = 0;
  for (int n = 0; n < scaled(2000); ++n) {
    const int corners = random.integer(4, kernels::most_corners_of_prism);
    const Solid solid = star(random, corners);
    if (solid.kind != SolidKind::prism) continue;
    ++prisms;
    const auto& s = *static_cast<const Prism*>(solid.any().shape);
    for (int ray = 0; ray < 20; ++ray) {
      const kernels::PlanarCorner<double>& at = s.corners[random.integer(0, s.count - 1)];
      const double angle = random.uniform(0, 6.2);
      kernels::PlanarRay<double> seen{random.uniform(-8, 8), random.uniform(-8, 8), std::cos(angle),
                                      std::sin(angle), false};
      if (random.chance(0.3)) {  // through a corner, or nearly
        seen.x = at.x - 2 * seen.u;
        seen.y = at.y - 2 * seen.v;
      }
      const double close = random.chance(0.5) ? 1e-9 : 0;
      const kernels::CornerSides<double> at_once(s, seen, close);
      kernels::CornerSides<double> one_by_one = at_once;
      one_by_one.near = 0;
      kernels::tell_sides<double>(one_by_one, s, seen, close);
      ASSERT_EQ(at_once.near, one_by_one.near);
      near += at_once.near;
      for (int i = 0; i < s.count; ++i) {
        ASSERT_EQ(bits(at_once.of[i]), bits(one_by_one.of[i]));
        ASSERT_EQ(at_once.left[i / 64] >> i % 64 & 1, one_by_one.left[i / 64] >> i % 64 & 1);
      }
      const double distance2 = kernels::edges_distance2(s, seen.x, seen.y);
      ASSERT_EQ(bits(distance2), bits(kernels::edges_distance2<double>(s, seen.x, seen.y)));
    }
  }
  EXPECT_GT(prisms, scaled(1500));
  EXPECT_GT(near, scaled(2000));
}

}  // namespace
}  // namespace navjit::test
