// Groups of eight boxes around triangles, and leaves of eight triangles: what they offer to a ray.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
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

/// For each facet, how often it is offered.
std::vector<int> offered(const Facets<double>& s, const Vec3& p, const Direction& v,
                         double margin) {
  std::vector<int> times(static_cast<std::size_t>(s.facet_count), 0);
  kernels::visit_met(s, kernels::ray_frame(p, v), v, margin,
                     [&](int k) { ++times.at(static_cast<std::size_t>(k)); });
  return times;
}

/// Points and directions; some are along axes, from corners and in the planes of boxes.
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

/// The numbers by lane.
template <class Number>
std::array<Number, 8> numbers(const kernels::EightOf<Number>& eight) {
  std::array<Number, 8> by_lane;
  std::memcpy(by_lane.data(), &eight, sizeof eight);
  return by_lane;
}
std::array<Vec3, 8> places(const kernels::EightCorners<double>& corners) {
  std::array<Vec3, 8> by_lane;
  const auto x = numbers(corners.x), y = numbers(corners.y), z = numbers(corners.z);
  for (std::size_t lane = 0; lane < 8; ++lane) by_lane[lane] = {x[lane], y[lane], z[lane]};
  return by_lane;
}

/// Each facet must be in one lane of the leaves; all other lanes have their corners in one place.
void expect_leaves_of_all_facets(const Facets<double>& s) {
  std::vector<kernels::FacetLeaf<double>> leaves(s.leaves, s.leaves + s.leaf_count);
  std::sort(leaves.begin(), leaves.end(),
            [](const auto& one, const auto& other) { return one.first < other.first; });
  ASSERT_EQ(leaves[0].first, 0);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const kernels::FacetLeaf<double>& leaf = leaves[i];
    const int end = i + 1 < leaves.size() ? leaves[i + 1].first : s.facet_count;
    ASSERT_TRUE(end > leaf.first && end <= leaf.first + 8) << end - leaf.first;
    const auto a = places(leaf.a), b = places(leaf.b), c = places(leaf.c);
    for (std::size_t lane = 0; lane < 8; ++lane) {
      const int k = leaf.first + static_cast<int>(lane);
      if (k < end) {
        EXPECT_TRUE(a[lane] == s.corners[s.facets[k].a] && b[lane] == s.corners[s.facets[k].b] &&
                    c[lane] == s.corners[s.facets[k].c]);
      } else {
        EXPECT_TRUE(a[lane] == b[lane] && b[lane] == c[lane]);
      }
    }
  }
}

/// Leaves below a group must be within the boxes of its lanes, and each is below one lane.
void expect_boxes_around_leaves(const Facets<double>& s, int group, std::vector<int>& found) {
  const kernels::FacetGroup<double>& g = s.groups[group];
  const std::array low{numbers(g.x_low), numbers(g.y_low), numbers(g.z_low)};
  const std::array high{numbers(g.x_high), numbers(g.y_high), numbers(g.z_high)};
  const auto below = numbers(g.below);
  for (std::size_t lane = 0; lane < 8; ++lane) {
    if (low[0][lane] > high[0][lane]) continue;
    const std::size_t before = found.size();
    if (below[lane] < 0) {
      found.push_back(-1 - below[lane]);
    } else {
      ASSERT_GT(below[lane], group);
      expect_boxes_around_leaves(s, below[lane], found);
    }
    for (std::size_t i = before; i < found.size(); ++i) {
      const kernels::FacetLeaf<double>& leaf = s.leaves[found[i]];
      for (const auto& corners : {leaf.a, leaf.b, leaf.c}) {
        const std::array at{numbers(corners.x), numbers(corners.y), numbers(corners.z)};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          for (const double x : at[axis]) {
            EXPECT_TRUE(low[axis][lane] <= x && x <= high[axis][lane]);
          }
        }
      }
    }
  }
}

TEST(FacetGroups, HoldEachFacetOnce) {
  for (const int cuts : {0, 1, 2, 3, 4}) {
    SCOPED_TRACE(cuts);
    const Solid ball = make_tessellated("ball", tests::ball(cuts));
    const Facets<double>& s = facets_of(ball);
    expect_leaves_of_all_facets(s);
    std::vector<int> found;
    expect_boxes_around_leaves(s, 0, found);
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found.size(), static_cast<std::size_t>(s.leaf_count));
    for (int i = 0; i < s.leaf_count; ++i) EXPECT_EQ(found[static_cast<std::size_t>(i)], i);
  }
}

/// The line through a point: any point, or one of a corner or of an edge of one of the
/// triangles.
kernels::RayFrame<double> line_near(std::mt19937_64& random, std::span<const Vec3> corners) {
  const auto one = [&random] { return std::uniform_real_distribution<double>(-1, 1)(random); };
  const std::size_t k = random() % (corners.size() / 3) * 3, i = random() % 3;
  const Vec3 &a = corners[k + i], &b = corners[k + (i + 1) % 3];
  const double along = random() % 2 == 0 ? 0.5 + 0.6 * one() : 0;
  Vec3 through = a + along * (b - a);
  if (random() % 3 == 0) through = through + 2 * Vec3{one(), one(), one()};
  Vec3 d{one(), one(), one()};
  if (random() % 4 == 0) (random() % 2 == 0 ? d.x : d.y) = 0;
  if (random() % 8 == 0) d = {0, 0, 1};
  if (random() % 8 == 0) d = b - a;
  const double n = norm(d);
  if (!(n > 0)) d = {1, 0, 0};
  const auto v = n > 0 ? kernels::make_direction(d.x / n, d.y / n, d.z / n)
                       : kernels::make_direction(1.0, 0.0, 0.0);
  return kernels::ray_frame(through + (-5 * one()) * Vec3{v.x, v.y, v.z}, v);
}

TEST(FacetLeaves, LeaveOutOnlyWhatIsNotCrossed) {
  std::mt19937_64 random(11);
  const auto one = [&random] { return std::uniform_real_distribution<double>(-1, 1)(random); };
  int offered = 0, crossed = 0, all = 0;
  for (int n = 0; n < 20000; ++n) {
    // Eight triangles: slivers, some without a surface, some that share corners.
    std::vector<Vec3> corners(24);
    for (Vec3& p : corners) {
      p = {one(), one(), one()};
      if (random() % 4 == 0) p = corners[random() % 24];
    }
    for (std::size_t k = 0; k < 24; k += 3) {
      if (random() % 3 != 0) continue;
      const double small = std::pow(10.0, -16.0 * std::abs(one()));
      corners[k + 2] = corners[k] + (0.5 + one()) * (corners[k + 1] - corners[k]) +
                       small * Vec3{one(), one(), one()};
    }
    std::vector<kernels::Facet> facets;
    kernels::FacetLeaf<double> leaf{};
    leaf.first = 0;
    const auto set = [&](kernels::EightCorners<double>& of, int lane, const Vec3& p) {
      const auto offset = static_cast<std::size_t>(lane) * sizeof(double);
      std::memcpy(reinterpret_cast<char*>(&of.x) + offset, &p.x, sizeof(double));
      std::memcpy(reinterpret_cast<char*>(&of.y) + offset, &p.y, sizeof(double));
      std::memcpy(reinterpret_cast<char*>(&of.z) + offset, &p.z, sizeof(double));
    };
    for (int lane = 0; lane < 8; ++lane) {
      facets.push_back({3 * lane, 3 * lane + 1, 3 * lane + 2});
      set(leaf.a, lane, corners[static_cast<std::size_t>(3 * lane)]);
      set(leaf.b, lane, corners[static_cast<std::size_t>(3 * lane + 1)]);
      set(leaf.c, lane, corners[static_cast<std::size_t>(3 * lane + 2)]);
    }
    Facets<double> s{};
    s.corners = corners.data();
    s.facets = facets.data();
    for (int line = 0; line < 20; ++line) {
      const kernels::RayFrame<double> frame = line_near(random, corners);
      const unsigned lanes = kernels::lanes_crossed(leaf, frame);
      for (int lane = 0; lane < 8; ++lane) {
        double t = 0;
        const bool is_crossed =
            kernels::facet_turn(s, frame, facets[static_cast<std::size_t>(lane)], t) != 0;
        const bool is_offered = (lanes >> lane & 1) != 0;
        ASSERT_TRUE(is_offered || !is_crossed) << n << " " << line << " " << lane;
        offered += is_offered ? 1 : 0;
        crossed += is_crossed ? 1 : 0;
        ++all;
      }
    }
  }
  EXPECT_GT(crossed, all / 50);
  EXPECT_LT(offered, all / 3) << "they leave most of them out";
}

}  // namespace
}  // namespace navjit
