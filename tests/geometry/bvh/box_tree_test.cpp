// The contract of the traversals, checked on random boxes and rays.
#include "geometry/bvh/box_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/geometry/bvh/oracle.hpp"

namespace navjit::bvh {
namespace {

using namespace test;

struct Case {
  Structure structure;
  std::size_t count;
  double scale;
};

class BoxTreeContract : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const Case& param = GetParam();
    const double edge = 4 / std::cbrt(static_cast<double>(param.count) + 1);
    boxes_ = boxes(generator_, param.count, param.scale, edge * param.scale);
    tree_ = BoxTree(boxes_, 0, param.structure);
    queries_ = param.count > 1000 ? 100 : param.count > 500 ? 400 : 1000;
  }

  /// Inside the cloud of boxes, around it, on a box, or far away.
  Vec3 origin() {
    const double scale = GetParam().scale;
    constexpr double far[] = {1e2, 1e4, 1e6};
    switch (pick(generator_, 5)) {
      case 0:
        return point(generator_, 3 * scale);
      case 1:
        return point(generator_, far[pick(generator_, 3)] * scale);
      case 2:
        if (!boxes_.empty()) return target(generator_, boxes_[some_box()]);
        [[fallthrough]];
      default:
        return point(generator_, scale);
    }
  }
  std::size_t some_box() { return pick(generator_, boxes_.size()); }

  Generator generator_{20140807};
  std::vector<Extent> boxes_;
  BoxTree tree_;
  int queries_ = 0;
};

TEST_P(BoxTreeContract, NoRayMissesABox) {
  constexpr double limits[] = {infinity, infinity, 1, 0.1, 0};
  for (int i = 0; i < queries_; ++i) {
    const Vec3 p = origin();
    const double limit = limits[pick(generator_, 5)] * GetParam().scale;
    check_ray(tree_, boxes_, p, direction(generator_), limit);
    if (boxes_.empty()) continue;
    const Vec3 aim = target(generator_, boxes_[some_box()]);
    if (aim.x == p.x && aim.y == p.y && aim.z == p.z) continue;
    check_ray(tree_, boxes_, p, towards(p, aim), limit);
  }
}

TEST_P(BoxTreeContract, NoPointMissesABox) {
  constexpr double radii[] = {infinity, 1, 0.1, 1e-3, 0};
  for (int i = 0; i < queries_; ++i) {
    check_point(tree_, boxes_, origin(), radii[pick(generator_, 5)] * GetParam().scale);
  }
}

TEST_P(BoxTreeContract, ShrinkingLimitsFindTheNearestBox) {
  for (int i = 0; i < queries_; ++i) {
    const Vec3 p = origin();
    const Direction v =
        boxes_.empty() ? direction(generator_) : towards(p, point(generator_, GetParam().scale));
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
  for (const Structure& structure : structures()) {
    for (const std::size_t count : {0, 1, 7, 8, 9, 64, 65, 512, 513}) {
      for (const double scale : {1e-6, 1.0, 1e4, 1e9}) result.push_back({structure, count, scale});
    }
    result.push_back({structure, 10000, 1e3});
  }
  return result;
}

std::string case_name(const testing::TestParamInfo<Case>& tested) {
  const Case& c = tested.param;
  return name_of(c.structure) + "_" + std::to_string(c.count) + "_boxes_scale_" +
         std::to_string(std::lround(std::log10(c.scale) + 6)) + "_decades_above_nm";
}
INSTANTIATE_TEST_SUITE_P(Random, BoxTreeContract, testing::ValuesIn(cases()), case_name);

}  // namespace
}  // namespace navjit::bvh
