#include "geometry/bvh/box_tree.hpp"

#include <gtest/gtest.h>
#ifdef __SSE2__
#include <pmmintrin.h>
#endif

#include <algorithm>
#include <limits>
#include <set>

#include "geometry/bvh/box_tree_traversal.hpp"
#include "tests/geometry/bvh/random_boxes.hpp"

namespace navjit::bvh {
namespace {

using test::Generator;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Method methods[] = {Method::linear, Method::two_level};

// The oracle: extended precision, plain definitions, no tree.
struct Path {
  long double enter, leave;
  bool meets(double limit) const { return enter <= leave && leave >= 0 && enter <= limit; }
};

Path path_in(const Extent& box, const Vec3& p, const Direction& v, double margin = 0) {
  const double low[3] = {box.min.x, box.min.y, box.min.z};
  const double high[3] = {box.max.x, box.max.y, box.max.z};
  const double at[3] = {p.x, p.y, p.z}, along[3] = {v.x, v.y, v.z};
  Path path{0, infinity};
  for (int axis = 0; axis < 3; ++axis) {
    const long double below = static_cast<long double>(low[axis]) - margin - at[axis];
    const long double above = static_cast<long double>(high[axis]) + margin - at[axis];
    if (along[axis] == 0) {
      if (below > 0 || above < 0) return {1, -1};
      continue;
    }
    const long double a = below / along[axis], b = above / along[axis];
    path.enter = std::max(path.enter, std::min(a, b));
    path.leave = std::min(path.leave, std::max(a, b));
  }
  return path;
}

long double distance_of(const Extent& box, const Vec3& p) {
  const auto outside = [](double low, double high, double x) {
    return std::max({static_cast<long double>(low) - x, static_cast<long double>(x) - high, 0.0L});
  };
  const long double x = outside(box.min.x, box.max.x, p.x), y = outside(box.min.y, box.max.y, p.y),
                    z = outside(box.min.z, box.max.z, p.z);
  return std::sqrt(x * x + y * y + z * z);
}

double reach(const Extent& box, const Vec3& p) {
  double result = 0;
  for (const double x :
       {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z, p.x, p.y, p.z}) {
    result = std::max(result, std::fabs(x));
  }
  return result;
}

/// The rounding of a tree stays within this of a box, for points and boxes of a given reach.
double slack(double reach) { return reach * 0x1p-20 + 0x1p-98; }

Direction towards(const Vec3& from, const Vec3& to) {
  return test::normalised(to.x - from.x, to.y - from.y, to.z - from.z);
}

/// A corner, or a point on an edge, on a face or within.
Vec3 target(Generator& generator, const Extent& box) {
  const auto choose = [&](double low, double high) {
    const std::size_t way = test::pick(generator, 3);
    return way == 0 ? low : way == 1 ? high : test::uniform(generator, low, high);
  };
  return {choose(box.min.x, box.max.x), choose(box.min.y, box.max.y), choose(box.min.z, box.max.z)};
}

/// Visits with a constant limit; asserts the contract for one ray.
void check_ray(const BoxTree& tree, std::span<const Extent> boxes, const Vec3& p,
               const Direction& v, double limit) {
  std::vector<int> visits(boxes.size());
  tree.along_ray(p, v, limit, [&](std::uint32_t i, double enter) {
    ++visits.at(i);
    const double margin = slack(reach(boxes[i], p));
    EXPECT_GE(enter, 0);
    EXPECT_LE(enter, limit);
    const Path path = path_in(boxes[i], p, v);
    if (path.meets(limit)) {
      EXPECT_LE(static_cast<long double>(enter), path.enter);
    }
    // Nothing is visited that is not close to being met.
    EXPECT_TRUE(path_in(boxes[i], p, v, margin).meets(limit + margin)) << "false hit of box " << i;
    return limit;
  });
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const bool met = path_in(boxes[i], p, v).meets(limit);
    EXPECT_LE(visits[i], 1);
    EXPECT_TRUE(visits[i] == 1 || !met) << "missed box " << i;
  }
}

void check_point(const BoxTree& tree, std::span<const Extent> boxes, const Vec3& p, double radius) {
  std::vector<int> contained(boxes.size()), close(boxes.size());
  tree.containing(p, [&](std::uint32_t i) {
    ++contained.at(i);
    EXPECT_LE(distance_of(boxes[i], p), 2 * slack(reach(boxes[i], p)));
    return true;
  });
  tree.near(p, radius, [&](std::uint32_t i, double bound) {
    ++close.at(i);
    const long double distance = distance_of(boxes[i], p);
    EXPECT_LE(static_cast<long double>(bound), distance);
    EXPECT_GE(static_cast<long double>(bound), distance - 4 * slack(reach(boxes[i], p)));
    EXPECT_LT(bound, radius);
    return radius;
  });
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const long double distance = distance_of(boxes[i], p);
    EXPECT_EQ(contained[i] == 1, contained[i] != 0);
    EXPECT_TRUE(contained[i] == 1 || distance > 0) << "containing missed box " << i;
    EXPECT_LE(close[i], 1);
    EXPECT_TRUE(close[i] == 1 || distance >= radius) << "near missed box " << i;
  }
}

struct Case {
  Method method;
  std::size_t count;
  double scale;
};

class BoxTreeContract : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const Case& param = GetParam();
    const double edge = 4 / std::cbrt(static_cast<double>(param.count) + 1);
    boxes_ = test::boxes(generator_, param.count, param.scale, edge * param.scale);
    tree_ = BoxTree(boxes_, 0, param.method);
    queries_ = param.count > 1000 ? 200 : 1500;
  }

  /// Inside the cloud of boxes, around it, on a box, or far away.
  Vec3 origin() {
    const double scale = GetParam().scale;
    constexpr double far[] = {1e2, 1e4, 1e6};
    switch (test::pick(generator_, 5)) {
      case 0:
        return test::point(generator_, 3 * scale);
      case 1:
        return test::point(generator_, far[test::pick(generator_, 3)] * scale);
      case 2:
        if (!boxes_.empty()) return target(generator_, boxes_[some_box()]);
        [[fallthrough]];
      default:
        return test::point(generator_, scale);
    }
  }
  std::size_t some_box() { return test::pick(generator_, boxes_.size()); }

  Generator generator_{20140807};
  std::vector<Extent> boxes_;
  BoxTree tree_;
  int queries_ = 0;
};

TEST_P(BoxTreeContract, NoRayMissesABox) {
  constexpr double limits[] = {infinity, infinity, 1, 0.1, 0};
  for (int i = 0; i < queries_; ++i) {
    const Vec3 p = origin();
    const double limit = limits[test::pick(generator_, 5)] * GetParam().scale;
    check_ray(tree_, boxes_, p, test::direction(generator_), limit);
    if (boxes_.empty()) continue;
    const Vec3 aim = target(generator_, boxes_[some_box()]);
    if (aim.x == p.x && aim.y == p.y && aim.z == p.z) continue;
    check_ray(tree_, boxes_, p, towards(p, aim), limit);
  }
}

TEST_P(BoxTreeContract, NoPointMissesABox) {
  constexpr double radii[] = {infinity, 1, 0.1, 1e-3, 0};
  for (int i = 0; i < queries_; ++i) {
    check_point(tree_, boxes_, origin(), radii[test::pick(generator_, 5)] * GetParam().scale);
  }
}

TEST_P(BoxTreeContract, ShrinkingLimitsFindTheNearestBox) {
  for (int i = 0; i < queries_; ++i) {
    const Vec3 p = origin();
    const Direction v = boxes_.empty() ? test::direction(generator_)
                                       : towards(p, test::point(generator_, GetParam().scale));
    long double nearest = infinity, closest = infinity;
    for (const Extent& box : boxes_) {
      const Path path = path_in(box, p, v);
      if (path.meets(infinity)) nearest = std::min(nearest, path.enter);
      closest = std::min(closest, distance_of(box, p));
    }
    // Limits are doubles: round up what the exact answer is.
    const auto round_up = [](long double x) {
      return std::nextafter(static_cast<double>(x), infinity);
    };
    long double found = infinity;
    double limit = infinity;
    tree_.along_ray(p, v, limit, [&](std::uint32_t index, double enter) {
      EXPECT_LE(enter, limit);
      const Path path = path_in(boxes_[index], p, v);
      if (path.meets(infinity)) found = std::min(found, path.enter);
      return limit = std::min(limit, round_up(found));
    });
    EXPECT_EQ(found, nearest);

    long double safety = infinity;
    double radius = infinity;
    tree_.near(p, radius, [&](std::uint32_t index, double bound) {
      EXPECT_LT(bound, radius);
      safety = std::min(safety, distance_of(boxes_[index], p));
      return radius = std::min(radius, round_up(safety));
    });
    EXPECT_EQ(safety, closest);
  }
}

std::vector<Case> cases() {
  std::vector<Case> result;
  for (const Method method : methods) {
    for (const std::size_t count : {0, 1, 7, 8, 9, 65, 600}) {
      for (const double scale : {1e-6, 1.0, 1e4, 1e9}) result.push_back({method, count, scale});
    }
    result.push_back({method, 10000, 1e3});
  }
  return result;
}

std::string case_name(const testing::TestParamInfo<Case>& tested) {
  const Case& c = tested.param;
  return std::string(c.method == Method::linear ? "linear_" : "two_level_") +
         std::to_string(c.count) + "_boxes_scale_" +
         std::to_string(std::lround(std::log10(c.scale) + 6)) + "_decades_above_nm";
}
INSTANTIATE_TEST_SUITE_P(Random, BoxTreeContract, testing::ValuesIn(cases()), case_name);

class BoxTreeMethods : public testing::TestWithParam<Method> {};
std::string method_name(const testing::TestParamInfo<Method>& tested) {
  return tested.param == Method::linear ? "linear" : "two_level";
}
INSTANTIATE_TEST_SUITE_P(Both, BoxTreeMethods, testing::ValuesIn(methods), method_name);

TEST_P(BoxTreeMethods, RaysOnFacesAndEdgesOfAGrid) {
  constexpr double edge = 0.1;  // not a float
  const std::vector<Extent> boxes = test::grid(6, edge);
  const BoxTree tree(boxes, 0, GetParam());
  Generator generator(1);
  for (int i = 0; i < 4000; ++i) {
    const auto lattice = [&] { return (static_cast<int>(test::pick(generator, 9)) - 4) * edge; };
    const auto anywhere = [&] {
      return test::pick(generator, 3) == 0 ? test::uniform(generator, -edge, edge) : lattice();
    };
    const Vec3 p{anywhere(), anywhere(), anywhere()};
    const auto step = [&] { return static_cast<double>(test::pick(generator, 3)) - 1; };
    const Vec3 v{step(), step(), step()};
    if (v.x == 0 && v.y == 0 && v.z == 0) continue;
    check_ray(tree, boxes, p, test::normalised(v.x, v.y, v.z),
              test::pick(generator, 2) == 0 ? infinity : edge);
    check_point(tree, boxes, p, test::pick(generator, 2) == 0 ? infinity : edge);
  }
}

TEST_P(BoxTreeMethods, ABoxEnteredAtTheLimitIsVisited) {
  Generator generator(2);
  for (int i = 0; i < 2000; ++i) {
    const double near = test::uniform(generator, 0, 1e4);
    const std::vector<Extent> boxes{{{near, -1, -1}, {near, 1, 1}}};
    const BoxTree tree(boxes, 0, GetParam());
    const double x = test::uniform(generator, -1e4, near);
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
  std::vector<Extent> boxes = test::grid(3, 1);
  boxes.push_back({{-infinity, -infinity, 10}, {infinity, infinity, infinity}});
  boxes.push_back({{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}});
  const BoxTree tree(boxes, 0, GetParam());
  std::set<std::uint32_t> seen;
  const auto visit = [&](std::uint32_t i, double) { return seen.insert(i), infinity; };
  tree.along_ray({5, 5, 0}, kernels::make_direction(0.0, 0.0, 1.0), infinity, visit);
  EXPECT_TRUE(seen.contains(27) && seen.contains(28));
  seen.clear();
  tree.along_ray({5, 5, 20}, test::normalised(1, 1, -1), infinity, visit);
  EXPECT_TRUE(seen.contains(27) && seen.contains(28));
  seen.clear();
  tree.near({5, 5, 8}, infinity, visit);
  EXPECT_EQ(seen.size(), 29u);
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
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST_P(BoxTreeMethods, TheSameBoxesGiveTheSameOrder) {
  Generator generator(3);
  const std::vector<Extent> boxes = test::boxes(generator, 3000, 100, 40);
  const BoxTree a(boxes, 1e-6, GetParam()), b(boxes, 1e-6, GetParam());
  for (int i = 0; i < 50; ++i) {
    const Vec3 p = test::point(generator, 100);
    const Direction v = test::direction(generator);
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
  for (const Method method : methods) {
    EXPECT_THROW(BoxTree(bad, 0, method), GeometryError);
    EXPECT_THROW(BoxTree(good, nan, method), GeometryError);
    EXPECT_THROW(BoxTree(good, -1, method), GeometryError);
  }
}

TEST(BoxTree, GroupsPerClusterChangeNothingButSpeed) {
  Generator generator(4);
  const std::vector<Extent> boxes = test::boxes(generator, 700, 10, 3);
  for (std::uint32_t groups = 1; groups <= 8; ++groups) {
    const BoxTree tree(boxes, 0, Method::two_level, groups);
    EXPECT_EQ(tree.clusters(), (700 + 8 * groups - 1) / (8 * groups));
    for (int i = 0; i < 100; ++i) {
      check_ray(tree, boxes, test::point(generator, 12), test::direction(generator), 8);
    }
  }
}

TEST(BoxTree, DefaultMethodTurnsToTwoLevelsOnce) {
  Method last = Method::linear;
  for (std::size_t count = 0; count < 2000; ++count) {
    const Method method = default_method(count);
    EXPECT_TRUE(last == Method::linear || method == Method::two_level);
    last = method;
  }
  EXPECT_EQ(default_method(0), Method::linear);
  EXPECT_EQ(last, Method::two_level);
}

}  // namespace
}  // namespace navjit::bvh
