// Faces, ties, unbounded boxes and orders, which random boxes do not reach.
#include <gtest/gtest.h>
#ifdef __SSE2__
#include <pmmintrin.h>
#endif

#include <algorithm>
#include <set>
#include <string>

#include "geometry/bvh/box_tree.hpp"
#include "tests/geometry/bvh/oracle.hpp"

namespace navjit::bvh {
namespace {

using namespace test;

class BoxTreeMethods : public testing::TestWithParam<Structure> {};
INSTANTIATE_TEST_SUITE_P(All, BoxTreeMethods, testing::ValuesIn(structures()),
                         [](const auto& tested) { return name_of(tested.param); });

TEST_P(BoxTreeMethods, RaysOnFacesAndEdgesOfAGrid) {
  constexpr double edge = 0.1;  // not a float
  const std::vector<Extent> boxes = grid(6, edge);
  const BoxTree tree(boxes, 0, GetParam());
  Generator generator(1);
  for (int i = 0; i < 4000; ++i) {
    const auto lattice = [&] { return (static_cast<int>(pick(generator, 9)) - 4) * edge; };
    const auto anywhere = [&] {
      return pick(generator, 3) == 0 ? uniform(generator, -edge, edge) : lattice();
    };
    const Vec3 p{anywhere(), anywhere(), anywhere()};
    const auto step = [&] { return static_cast<double>(pick(generator, 3)) - 1; };
    const Vec3 v{step(), step(), step()};
    if (v.x == 0 && v.y == 0 && v.z == 0) continue;
    check_ray(tree, boxes, p, normalised(v.x, v.y, v.z), pick(generator, 2) == 0 ? infinity : edge);
    check_point(tree, boxes, p, pick(generator, 2) == 0 ? infinity : edge);
  }
}

TEST_P(BoxTreeMethods, ABoxEnteredAtTheLimitIsVisited) {
  Generator generator(2);
  for (int i = 0; i < 2000; ++i) {
    const double near = uniform(generator, 0, 1e4);
    const std::vector<Extent> boxes{{{near, -1, -1}, {near, 1, 1}}};
    const BoxTree tree(boxes, 0, GetParam());
    const double x = uniform(generator, -1e4, near);
    const double limit = near - x;
    if (x + limit < near) continue;  // the exact difference is above this limit
    int visits = 0;
    tree.along_ray({x, 0, 0}, kernels::make_direction(1.0, 0.0, 0.0), limit,
                   [&](std::uint32_t, double) { return ++visits, limit; });
    EXPECT_EQ(visits, 1);
  }
}

TEST_P(BoxTreeMethods, ReciprocalsBeyondTheRangeOfFloats) {
  const std::vector<Extent> boxes{{{1e-29, 0, 0}, {1, 1, 1e11}}, {{-1, 0, 0}, {-1e-29, 1, 1e11}}};
  const BoxTree tree(boxes, 0, GetParam());
  for (const double x : {1e-39, 1e-38, 1e-35, -1e-39, -1e-36}) {
    const Direction v = kernels::make_direction(x, 0.0, 1.0);
    ASSERT_TRUE(path_in(boxes[x < 0], {0, 0, 0}, v).meets(infinity));
    check_ray(tree, boxes, {0, 0, 0}, v, infinity);
  }
}

TEST_P(BoxTreeMethods, TheToleranceInflates) {
  const std::vector<Extent> boxes{{{0, 0, 0}, {1, 1, 1}}};
  const BoxTree tight(boxes, 0, GetParam()), wide(boxes, 0.25, GetParam());
  const auto contains = [](const BoxTree& tree, double x) {
    bool found = false;
    tree.containing({x, 0.5, 0.5}, [&](std::uint32_t) { return found = true; });
    return found;
  };
  EXPECT_TRUE(contains(tight, 1));
  EXPECT_FALSE(contains(tight, 1.001));
  EXPECT_TRUE(contains(wide, 1.25));
  EXPECT_FALSE(contains(wide, 1.251));
}

TEST_P(BoxTreeMethods, IdenticalBoxesAreAllVisited) {
  const std::vector<Extent> boxes(1000, {{1, 2, 3}, {4, 5, 6}});
  const BoxTree tree(boxes, 1e-9, GetParam());
  check_ray(tree, boxes, {0, 0, 0}, towards({0, 0, 0}, {2, 3, 4}), 100);
  check_point(tree, boxes, {2, 3, 4}, 100);
  std::set<std::uint32_t> seen;
  tree.containing({2, 3, 4}, [&](std::uint32_t i) {
    seen.insert(i);
    return seen.size() < 10;
  });
  EXPECT_EQ(seen.size(), 10u) << "the visitor's false ends the search";
}

TEST_P(BoxTreeMethods, UnboundedBoxesAreFound) {
  std::vector<Extent> boxes = grid(3, 1);
  boxes.push_back({{-infinity, -infinity, 10}, {infinity, infinity, infinity}});
  boxes.push_back({{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}});
  const BoxTree tree(boxes, 0, GetParam());
  std::set<std::uint32_t> seen;
  const auto visit = [&](std::uint32_t i, double) { return seen.insert(i), infinity; };
  tree.along_ray({5, 5, 0}, kernels::make_direction(0.0, 0.0, 1.0), infinity, visit);
  EXPECT_TRUE(seen.contains(27) && seen.contains(28));
  seen.clear();
  tree.along_ray({5, 5, 20}, normalised(1, 1, -1), infinity, visit);
  EXPECT_TRUE(seen.contains(27) && seen.contains(28));
  seen.clear();
  tree.near({5, 5, 8}, infinity, visit);
  EXPECT_EQ(seen.size(), 29u);
}

TEST_P(BoxTreeMethods, HostileBoxesNeitherHangNorHideOthers) {
  std::vector<Extent> boxes = grid(4, 1);
  const std::size_t good = boxes.size();
  const double huge = std::numeric_limits<double>::max();
  for (int i = 0; i < 100; ++i) {
    boxes.push_back({{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}});
    boxes.push_back({{2, 2, 2}, {1, 1, 1}});
    boxes.push_back({{-huge, -huge, -huge}, {huge, huge, huge}});
    boxes.push_back({{infinity, infinity, infinity}, {infinity, infinity, infinity}});
    boxes.push_back({{-infinity, 0, 0}, {1, 1, infinity}});
    boxes.push_back({{1e29, -1e29, 1e29}, {1e30, 1e-30, 1e30}});
  }
  const BoxTree tree(boxes, 0, GetParam());
  for (std::size_t i = 0; i < good; ++i) {
    const Vec3& low = boxes[i].min;
    const Vec3 inside{low.x + 0.5, low.y + 0.5, low.z + 0.5};
    std::vector<int> contained(boxes.size()), met(boxes.size()), close(boxes.size());
    tree.containing(inside, [&](std::uint32_t k) { return ++contained[k] > 0; });
    tree.along_ray(inside, normalised(1, 2, 3), 1e-3, [&](std::uint32_t k, double) {
      ++met[k];
      return 1e-3;
    });
    tree.near(inside, 1e-3, [&](std::uint32_t k, double) {
      ++close[k];
      return 1e-3;
    });
    for (const std::size_t k : {i, good + 2, good + 8}) {
      EXPECT_EQ(contained[k], 1) << k;
      EXPECT_EQ(met[k], 1) << k;
      EXPECT_EQ(close[k], 1) << k;
    }
  }
}

TEST_P(BoxTreeMethods, CandidatesComeNearestFirst) {
  std::vector<Extent> boxes;
  for (int i = 0; i < 40; ++i) {
    const double z = (i * 17) % 40;
    boxes.push_back({{-1, -1, z}, {1, 1, z + 1}});
  }
  const BoxTree tree(boxes, 0, GetParam());
  std::vector<double> order;
  tree.along_ray({0, 0, -1}, kernels::make_direction(0.0, 0.0, 1.0), infinity,
                 [&](std::uint32_t, double enter) { return order.push_back(enter), infinity; });
  EXPECT_EQ(order.size(), 40u);
  // Only this clustering makes runs of neighbours, so that no cluster begins within another.
  if (GetParam().clustering == Clustering::surface) {
    EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
  }
}

TEST_P(BoxTreeMethods, TheSameBoxesGiveTheSameOrder) {
  Generator generator(3);
  const std::vector<Extent> boxes = test::boxes(generator, 3000, 100, 40);
  const BoxTree a(boxes, 1e-6, GetParam()), b(boxes, 1e-6, GetParam());
  for (int i = 0; i < 50; ++i) {
    const Vec3 p = point(generator, 100);
    const Direction v = direction(generator);
    const auto trace = [&](const BoxTree& tree) {
      std::vector<std::pair<std::uint32_t, double>> visits;
      const auto visit = [&](std::uint32_t index, double bound) {
        return visits.emplace_back(index, bound), 50.0;
      };
      tree.along_ray(p, v, 50, visit);
      tree.near(p, 50, visit);
      return visits;
    };
    EXPECT_EQ(trace(a), trace(b));
  }
}

#ifdef __SSE2__
TEST_P(BoxTreeMethods, FlushedSubnormalsMissNothing) {
  struct Flush {
    unsigned before = _mm_getcsr();
    Flush() {
      _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
      _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    }
    ~Flush() { _mm_setcsr(before); }
  };
  for (const double x : {0.0, 1e-310, -1e-310, 1e-45, -1e-40, 1e-38}) {
    const std::vector<Extent> boxes{{{x - 1, -1, -1}, {x, 1, 1}}, {{x, -1, -1}, {x + 1, 1, 1}}};
    const BoxTree tree(boxes, 0, GetParam());
    const Direction along = kernels::make_direction(0.0, 0.0, 1.0);
    const Direction almost = kernels::make_direction(1e-42, 0.0, -1.0);
    int visits = 0;
    {
      const Flush flush;
      tree.along_ray({x, 0, 0}, along, 1, [&](std::uint32_t, double) { return ++visits, 1; });
      tree.along_ray({x, 0, 0}, almost, 1, [&](std::uint32_t, double) { return ++visits, 1; });
      tree.containing({x, 0, 0}, [&](std::uint32_t) { return ++visits, true; });
    }
    EXPECT_EQ(visits, 6) << x;
  }
}
#endif

TEST(BoxTree, RejectsWhatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Extent> good{{{0, 0, 0}, {1, 1, 1}}}, bad{{{0, 0, 0}, {1, nan, 1}}};
  for (const Structure& structure : structures()) {
    EXPECT_THROW(BoxTree(bad, 0, structure), GeometryError);
    EXPECT_THROW(BoxTree(good, nan, structure), GeometryError);
    EXPECT_THROW(BoxTree(good, -1, structure), GeometryError);
  }
}

TEST(BoxTree, GroupsPerClusterChangeNothingButSpeed) {
  Generator generator(4);
  const std::vector<Extent> boxes = test::boxes(generator, 700, 10, 3);
  for (std::uint32_t groups = 1; groups <= 8; ++groups) {
    const BoxTree tree(boxes, 0, {Method::two_level, Clustering::surface, groups});
    EXPECT_EQ(tree.clusters(), (700 + 8 * groups - 1) / (8 * groups));
    for (int i = 0; i < 100; ++i) {
      check_ray(tree, boxes, point(generator, 12), direction(generator), 8);
    }
  }
}

TEST(BoxTree, TheRegularTreeHasNoGroupToSpare) {
  Generator generator(5);
  for (const std::size_t count : {1, 8, 9, 64, 65, 512, 513, 4097}) {
    const std::vector<Extent> boxes = test::boxes(generator, count, 10, 3);
    for (const Structure& structure : structures()) {
      if (structure.method != Method::regular_tree) continue;
      EXPECT_EQ(BoxTree(boxes, 0, structure).clusters(), (count + 7) / 8);
    }
  }
}

}  // namespace
}  // namespace navjit::bvh
