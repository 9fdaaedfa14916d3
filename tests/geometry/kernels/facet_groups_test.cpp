// Groups of eight boxes around triangles: which triangles they offer a ray.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "geometry/solids/solid.hpp"
#include "tests/support/meshes.hpp"

namespace navjit {
namespace {

using kernels::Facets;

const Facets<double>& facets_of(const Solid& s) {
  return *static_cast<const Facets<double>*>(s.any().shape);
}

/// By facet, how often it is offered.
std::vector<int> offered(const Facets<double>& s, const Vec3& p, const Direction& v,
                         double margin) {
  std::vector<int> times(static_cast<std::size_t>(s.facet_count), 0);
  kernels::visit_met(s.groups, p, v, margin,
                     [&](int k) { ++times.at(static_cast<std::size_t>(k)); });
  return times;
}

/// Points and directions of which some are along axes, from corners and in the planes of boxes.
struct Rays {
  const Facets<double>& s;
  std::mt19937_64 random{7};

  double one() { return std::uniform_real_distribution<double>(-1, 1)(random); }
  Vec3 point() {
    const Vec3& corner = s.corners[random() % static_cast<unsigned>(s.corner_count)];
    switch (random() % 3) {
      case 0:
        return corner;
      case 1:
        return {corner.x, 12 * one(), corner.z};
      default:
        return {12 * one(), 12 * one(), 12 * one()};
    }
  }
  Direction direction() {
    Vec3 d{one(), one(), one()};
    if (random() % 3 == 0) (random() % 2 == 0 ? d.x : d.y) = 0;
    if (random() % 6 == 0) d = {0, 0, random() % 2 == 0 ? 1.0 : -1.0};
    const double n = norm(d);
    return kernels::make_direction(d.x / n, d.y / n, d.z / n);
  }
};

void expect_all_that_are_crossed(const Solid& solid, double most_share) {
  const Facets<double>& s = facets_of(solid);
  Rays rays{s};
  double crossed = 0, all = 0;
  for (int n = 0; n < 3000; ++n) {
    const Vec3 p = rays.point();
    const Direction v = rays.direction();
    const std::vector<int> times = offered(s, p, v, 1e-9);
    const kernels::RayFrame<double> frame = kernels::ray_frame(p, v);
    for (int k = 0; k < s.facet_count; ++k) {
      const int how_often = times[static_cast<std::size_t>(k)];
      ASSERT_LE(how_often, 1);
      all += how_often;
      double t = 0;
      if (kernels::facet_turn(s, frame, s.facets[k], t) == 0 || t < -1e-9) continue;
      ASSERT_EQ(how_often, 1) << "ray " << n << ", facet " << k;
      ++crossed;
    }
  }
  EXPECT_GT(crossed, 1000);
  EXPECT_LT(all / 3000, most_share * s.facet_count) << "it is a filter";
}

TEST(FacetGroups, OfferWhatIsCrossedOnce) {
  expect_all_that_are_crossed(make_tessellated("block", tests::block()), 1);
  for (const int cuts : {0, 1, 2, 3, 4}) {
    SCOPED_TRACE(cuts);
    expect_all_that_are_crossed(make_tessellated("ball", tests::ball(cuts)), cuts < 2   ? 1
                                                                             : cuts < 4 ? 0.2
                                                                                        : 0.05);
  }
}

TEST(FacetGroups, HoldEachFacetOnce) {
  // Along no axis, from far away, with a margin around everything.
  for (const int cuts : {0, 2, 3}) {
    const Solid ball = make_tessellated("ball", tests::ball(cuts));
    const auto times =
        offered(facets_of(ball), {-30, -30, -30}, kernels::make_direction(0.6, 0.64, 0.48), 100);
    EXPECT_EQ(times, std::vector<int>(times.size(), 1));
  }
}

}  // namespace
}  // namespace navjit
