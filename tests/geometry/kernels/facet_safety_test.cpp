// Safeties of triangle meshes against those of all their triangles: boxes leave out no nearer
// triangle, and the nearest one tells the side where it can.
#include <gtest/gtest.h>

#include <random>

#include "geometry/solids/any_solid.hpp"
#include "navjit/solids.hpp"
#include "tests/geometry/kernels/facet_oracles.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/worlds.hpp"

namespace navjit::test {
namespace {

using Mesh = tests::Mesh;

SignedDistance distance_of(const Mesh& mesh) {
  std::vector<Triangle> triangles;
  const auto wide = [](const Vec3& p) { return WidePoint{p.x, p.y, p.z}; };
  for (const FacetCorners& f : mesh) triangles.push_back({wide(f[0]), wide(f[1]), wide(f[2])});
  return triangles_distance(std::move(triangles));
}

Vec3 random_point(std::mt19937_64& random, double half) {
  using tests::uniform;
  return {uniform(random, -half, half), uniform(random, -half, half), uniform(random, -half, half)};
}

const kernels::Facets<double>& facets_of(const Solid& s) {
  return *static_cast<const kernels::Facets<double>*>(s.any().shape);
}

TEST(FacetSafety, IsTheDistanceToTheNearestOfAllTriangles) {
  std::mt19937_64 random(1);
  const Mesh mesh = tests::ball();
  const Solid s = make_tessellated("s", mesh);
  ASSERT_EQ(s.kind, SolidKind::facets);
  const SignedDistance distance = distance_of(mesh);
  int inside = 0, outside = 0, known = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p = random_point(random, i % 2 == 0 ? 11 : 40);
    const double expected = static_cast<double>(distance({p.x, p.y, p.z}));
    EXPECT_NEAR(safety_to_in(s.any(), p), std::max(expected, 0.0), 1e-12) << i;
    EXPECT_NEAR(safety_to_out(s.any(), p), std::max(-expected, 0.0), 1e-12) << i;
    ++(expected < 0 ? inside : outside);
    const int side = nearest_in_surface(facets_of(s), p, kernels::infinity<double>()).side;
    if (side == 0) continue;
    ++known;
    EXPECT_EQ(side, expected < 0 ? -1 : 1) << i;
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 500);
  EXPECT_GT(known, 800) << "no ray is asked then";
}

TEST(FacetSafety, LimitsOnlyLeaveOutWhatIsFarther) {
  std::mt19937_64 random(2);
  const Solid s = make_tessellated("s", tests::ball());
  int nearer = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p = random_point(random, 12);
    const double all = surface_distance2(facets_of(s), p, kernels::infinity<double>());
    const double limit = tests::uniform(random, 0, 20);
    EXPECT_EQ(surface_distance2(facets_of(s), p, limit), std::min(all, limit)) << i;
    nearer += all < limit ? 1 : 0;
  }
  EXPECT_GT(nearer, 1000);
  EXPECT_LT(nearer, 3500);
}

TEST(FacetSafety, HoldsForSlivers) {
  // The normals of needles are mostly rounding.
  std::mt19937_64 random(3);
  Mesh mesh = tests::block();
  for (FacetCorners& f : mesh) {
    for (Vec3& p : f) p = {1e3 * p.x + 1e-2 * p.y, 1e-2 * p.y, p.z};
  }
  const Solid s = make_tessellated("s", mesh);
  const SignedDistance distance = distance_of(mesh);
  for (int i = 0; i < 4000; ++i) {
    const Vec3 at = random_point(random, 2);
    const Vec3 p{3e3 * at.x, i % 2 == 0 ? 3e-2 * at.y : at.y, 2 * at.z};
    const double expected = static_cast<double>(distance({p.x, p.y, p.z}));
    EXPECT_LE(safety_to_in(s.any(), p), std::max(expected, 0.0) * (1 + 1e-9) + 1e-9) << i;
    EXPECT_LE(safety_to_out(s.any(), p), std::max(-expected, 0.0) * (1 + 1e-9) + 1e-9) << i;
    EXPECT_GE(safety_to_in(s.any(), p) + safety_to_out(s.any(), p),
              std::abs(expected) * (1 - 1e-9) - 1e-9)
        << i;
  }
}

TEST(FacetSafety, OfPartsThatOverlapIsNoMoreThanTheNearestFacetAway) {
  // Facets of either part are within the other.
  std::mt19937_64 random(4);
  Mesh mesh = tests::block();
  for (FacetCorners f : tests::block()) {
    for (Vec3& p : f) p = p + Vec3{4, 3, 2};
    mesh.push_back(f);
  }
  const Solid s = make_tessellated("s", mesh);
  const SignedDistance nearest = distance_of(mesh);
  int within_both = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p = random_point(random, 10);
    const double away = std::abs(static_cast<double>(nearest({p.x, p.y, p.z})));
    const double in = safety_to_in(s.any(), p), out = safety_to_out(s.any(), p);
    EXPECT_LE(in, away + 1e-12) << i;
    EXPECT_LE(out, away + 1e-12) << i;
    const bool holds = inside(s.any(), p, 1e-9) == kernels::Side::inside;
    if (!holds) {
      EXPECT_NEAR(in, away, 1e-12) << i;
      EXPECT_EQ(out, 0) << i;
    } else {
      EXPECT_NEAR(out, away, 1e-12) << i;
    }
    const auto within = [&](const Vec3& c) {
      return std::abs(p.x - c.x) < 5 && std::abs(p.y - c.y) < 4 && std::abs(p.z - c.z) < 3;
    };
    within_both += within({0, 0, 0}) && within({4, 3, 2}) ? 1 : 0;
  }
  EXPECT_GT(within_both, 10);
}

}  // namespace
}  // namespace navjit::test
