// Polygons of many corners, up to the most that a prism may have.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/solids/solid.hpp"

namespace navjit {
namespace {

constexpr double tolerance = 1e-9, pi = 3.14159265358979323846;

class ManyCorners : public testing::TestWithParam<int> {
 protected:
  /// A star: its corners are at two radii in turn.
  std::vector<PlanarPoint> corners() const {
    std::vector<PlanarPoint> made;
    for (int i = 0; i < GetParam(); ++i) {
      const double phi = 2 * pi * i / GetParam(), r = i % 2 == 0 ? 10 : 7;
      made.push_back({r * std::cos(phi), r * std::sin(phi)});
    }
    return made;
  }
  const Solid star_ =
      make_extruded("star", corners(), std::vector<ExtrudedSection>{{-5, 0, 0, 1}, {5, 0, 0, 1}});
};

/// Whether a point is inside, by counting the edges that are beside it.
bool is_within(std::span<const PlanarPoint> polygon, double x, double y) {
  bool within = false;
  for (std::size_t i = 0, before = polygon.size() - 1; i < polygon.size(); before = i++) {
    const PlanarPoint &a = polygon[before], &b = polygon[i];
    if ((a.y > y) != (b.y > y) && x < a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y)) within = !within;
  }
  return within;
}

TEST_P(ManyCorners, AreWithinAsEdgesSayOneByOne) {
  ASSERT_EQ(star_.kind, SolidKind::prism);
  const std::vector<PlanarPoint> polygon = corners();
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> at(-11, 11), along(-1, 1);
  int within = 0, crossings = 0;
  for (int ray = 0; ray < 2000; ++ray) {
    Vec3 p{at(random), at(random), 0.3 * along(random)};
    const double u = along(random), v = along(random), w = 0.01 * along(random);
    const double norm = std::sqrt(u * u + v * v + w * w);
    const Direction d = kernels::make_direction(u / norm, v / norm, w / norm);
    bool inside = is_within(polygon, p.x, p.y);
    ASSERT_EQ(contains(star_.any(), p, d, tolerance), inside) << ray;
    within += inside ? 1 : 0;
    // On from edge to edge: in the middle of each piece the edges have to agree.
    for (int i = 0; i < 50; ++i) {
      const double length = inside ? distance_to_out(star_.any(), p, d, tolerance)
                                   : distance_to_in(star_.any(), p, d, tolerance);
      if (!(length < 100)) break;
      const Vec3 middle = kernels::advance(p, d, length / 2);
      if (length > 1e-6) {
        ASSERT_EQ(is_within(polygon, middle.x, middle.y), inside) << ray << ' ' << i;
      }
      p = kernels::advance(p, d, length);
      inside = !inside;
      ++crossings;
      if (std::abs(p.z) > 4.9) break;
    }
  }
  EXPECT_GT(within, 500);
  EXPECT_GT(crossings, 1500);
}

INSTANTIATE_TEST_SUITE_P(Prism, ManyCorners,
                         testing::Values(16, 17, 40, 62, 63, 64, 65, 66, 100, 127, 128));

}  // namespace
}  // namespace navjit
