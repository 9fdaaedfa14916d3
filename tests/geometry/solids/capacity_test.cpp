// Volumes and extents against sampling; the oracles decide what is inside.
#include <gtest/gtest.h>

#include "tests/geometry/kernels/random_curved_solids.hpp"
#include "tests/geometry/kernels/random_flat_solids.hpp"

namespace navjit::test {
namespace {

class SampledSolid : public testing::TestWithParam<Maker> {};

TEST_P(SampledSolid, HasTheCapacityThatSamplingFinds) {
  Random random(41);
  constexpr int samples = 20000;
  for (int i = 0; i < 12; ++i) {
    const SolidCase c = GetParam().make(random);
    const Extent& e = c.solid.extent;
    int hits = 0;
    for (int k = 0; k < samples; ++k) {
      const Vec3 p = random.point_in(e, 0);
      if (c.distance({p.x, p.y, p.z}) < 0) ++hits;
    }
    const double box = (e.max.x - e.min.x) * (e.max.y - e.min.y) * (e.max.z - e.min.z);
    const double share = capacity(c.solid) / box;
    ASSERT_GT(share, 0);
    ASSERT_LE(share, 1 + 1e-12);
    const double sigma = std::sqrt(share * (1 - share) / samples);
    ASSERT_NEAR(static_cast<double>(hits) / samples, share, 5 * sigma + 1e-4);
  }
}

TEST_P(SampledSolid, FitsItsExtentTightly) {
  Random random(42);
  for (int i = 0; i < 20; ++i) {
    const SolidCase c = GetParam().make(random);
    const Extent& e = c.solid.extent;
    const double rounding = 1e-14 * c.size;
    for (int k = 0; k < 2000; ++k) {
      const Vec3 p = random.point_in(e, 0.2);
      if (c.distance({p.x, p.y, p.z}) >= 0) continue;
      ASSERT_TRUE(p.x >= e.min.x - rounding && p.x <= e.max.x + rounding);
      ASSERT_TRUE(p.y >= e.min.y - rounding && p.y <= e.max.y + rounding);
      ASSERT_TRUE(p.z >= e.min.z - rounding && p.z <= e.max.z + rounding);
    }
    // Each side of the box touches the solid: moving a plane inwards from it soon meets some.
    const double low[3] = {e.min.x, e.min.y, e.min.z}, high[3] = {e.max.x, e.max.y, e.max.z};
    for (int side = 0; side < 6; ++side) {
      const int axis = side / 2;
      Wide nearest = INFINITY;
      for (int k = 0; k < 1500; ++k) {
        double p[3];
        for (int j = 0; j < 3; ++j) p[j] = random.uniform(low[j], high[j]);
        p[axis] = side % 2 == 0 ? low[axis] : high[axis];
        nearest = std::min(nearest, std::max<Wide>(c.distance({p[0], p[1], p[2]}), 0));
      }
      ASSERT_LT(nearest, 0.1 * c.size) << kind_name(c.solid.kind) << " side " << side;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Primitives, SampledSolid, testing::ValuesIn(primitive_makers),
                         [](const testing::TestParamInfo<Maker>& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(Flat, SampledSolid, testing::ValuesIn(flat_makers),
                         [](const testing::TestParamInfo<Maker>& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Curved, SampledSolid, testing::ValuesIn(curved_makers),
                         [](const testing::TestParamInfo<Maker>& test) { return test.param.name; });

TEST(Capacity, MatchesTextbookVolumes) {
  constexpr double pi = std::numbers::pi;
  EXPECT_DOUBLE_EQ(capacity(make_box("s", 1, 2, 3)), 48);
  EXPECT_DOUBLE_EQ(capacity(make_tube("s", 1, 2, 3, 0, 2 * pi)), 18 * pi);
  EXPECT_DOUBLE_EQ(capacity(make_cone("s", 0, 3, 0, 0, 2, 0, 2 * pi)), 12 * pi);
  EXPECT_DOUBLE_EQ(capacity(make_trd("s", 3, 0, 3, 0, 2)), 48);
  EXPECT_DOUBLE_EQ(capacity(make_trap("s", 1, 0.3, 1, 2, 3, 3, 0.2, 2, 3, 3, 0.2)), 48);
  EXPECT_DOUBLE_EQ(capacity(make_orb("s", 3)), 36 * pi);
  EXPECT_DOUBLE_EQ(capacity(make_sphere("s", 0, 3, 0, pi, 0, pi / 2)), 9 * pi);
  const ZPlane planes[] = {{0, 0, 1}, {1, 0, 1}, {1, 0, 2}, {2, 0, 2}};
  EXPECT_DOUBLE_EQ(capacity(make_polycone("s", planes, 0, 2 * pi)), 5 * pi);
  EXPECT_NEAR(capacity(make_polyhedra("s", planes, 4, 0, 2 * pi)), 20, 1e-13);
}

TEST(Capacity, OfFlatSolidsIsRight) {
  for (const double height : {1.0, 1e-3, 3e-6, 1e-6}) {
    for (const double x : {0.0, 1000.0, -1e5}) {
      const Solid tet = make_tet("s", {x, 0, 0}, {x + 20, 0, 0}, {x, 20, 0}, {x + 5, 5, height});
      EXPECT_NEAR(capacity(tet), 200 * height / 3, 1e-4 * 200 * height / 3) << height << ' ' << x;
    }
  }
}

TEST(Capacity, OfFlatTetrahedraIsRightHoweverTheyAreTurned) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto any = [&] { return Vec3{normal(random), normal(random), normal(random)}; };
  for (int i = 0; i < 2000; ++i) {
    const Vec3 n = any(), up = (1 / norm(n)) * n;
    const auto corner = [&](double height) {
      const Vec3 p = 15 * any();
      return p + (height - dot(p, up)) * up;
    };
    const double height = i % 2 == 0 ? 1e-2 : 1e-3;
    const Vec3 a = corner(0), b = corner(0), c = corner(0), d = corner(height);
    const Vec3 u = b - a, v = c - a, w = d - a;
    const double exact = std::abs(u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) +
                                  u.z * (v.x * w.y - v.y * w.x)) /
                         6;
    // Slender triangles are less well known by their planes.
    if (exact < 0.3 * 30 * 30 * height / 6) continue;
    EXPECT_NEAR(capacity(make_tet("s", a, b, c, d)), exact, 1e-3 * exact) << i;
  }
}

TEST(Capacity, MatchesTextbookVolumesOfCurvedSolids) {
  constexpr double pi = std::numbers::pi;
  EXPECT_DOUBLE_EQ(capacity(make_torus("s", 1, 2, 5, 0.3, pi)), 15 * pi * pi);
  // Where the tube covers the axis; around a point it is a ball.
  EXPECT_NEAR(capacity(make_torus("s", 0, 1, 1e-9, 0, 2 * pi)), 4 * pi / 3, 1e-7);
  EXPECT_DOUBLE_EQ(capacity(make_torus("s", 0, 2, 2, 0, 2 * pi)), 16 * pi * pi);
  EXPECT_NEAR(capacity(make_torus("s", 1, 5, 3, 0, pi)),
              pi * (3 * (25 * (pi / 2 + std::asin(0.6)) + 12) + 128 / 3.0 - 3 * pi), 1e-11);
  EXPECT_DOUBLE_EQ(capacity(make_ellipsoid("s", 1, 2, 3, 0, 0)), 8 * pi);
  EXPECT_DOUBLE_EQ(capacity(make_ellipsoid("s", 1, 2, 3, 0, 5)), 4 * pi);
  EXPECT_DOUBLE_EQ(capacity(make_eltube("s", 1, 2, 3)), 12 * pi);
  EXPECT_DOUBLE_EQ(capacity(make_elcone("s", 1, 2, 3, 4)), 144 * pi);
  EXPECT_DOUBLE_EQ(capacity(make_paraboloid("s", 0, 2, 3)), 12 * pi);
  EXPECT_NEAR(capacity(make_hype("s", 0, 1, 0, pi / 4, 3)), 24 * pi, 1e-12);
  EXPECT_NEAR(capacity(make_hype("s", 0, 1, pi / 4, pi / 4, 3)), 6 * pi, 1e-12);
  EXPECT_DOUBLE_EQ(capacity(make_twistedbox("s", 1, 1, 2, 3)), 48);
  EXPECT_DOUBLE_EQ(capacity(make_twistedtrd("s", 3, 1, 3, 1, 2, 1)),
                   capacity(make_trd("s", 3, 1, 3, 1, 2)));
  // The mean width times the height times the length.
  EXPECT_DOUBLE_EQ(capacity(make_twistedtrap("s", 1, 3, 0.3, 1, 2, 1, 2, 2, 4, 1, 0.2)), 96);
  EXPECT_NEAR(capacity(make_twistedtubs("s", 0, 1, 2, -1, 2, 1)), 4.5, 1e-13);
}

TEST(Capacity, IsOpenForBooleansAndKeptByPlacing) {
  const Solid box = make_box("b", 1, 2, 3), orb = make_orb("o", 1);
  EXPECT_TRUE(std::isnan(capacity(make_union("u", box, orb))));
  EXPECT_DOUBLE_EQ(capacity(make_placed("p", box, {{1, 2, 3}})), 48);
}

}  // namespace
}  // namespace navjit::test
