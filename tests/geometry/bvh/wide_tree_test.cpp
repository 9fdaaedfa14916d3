#include "geometry/bvh/wide_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "geometry/solids/extent.hpp"
#include "tests/geometry/bvh/random_boxes.hpp"

namespace navjit::bvh {
namespace {

using test::Generator;

/// Every box must occur once, and every node but the root once and after the node above it. Bounds
/// must enclose all that is below, and no path may be longer than the limit.
void check(const std::vector<WideNode>& nodes, const std::vector<Extent>& boxes) {
  std::vector<int> seen(boxes.size()), level(nodes.size(), -1);
  if (!nodes.empty()) level[0] = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    ASSERT_GE(level[n], 0) << n;
    ASSERT_LT(level[n], static_cast<int>(wide_tree_levels));
    ASSERT_GE(nodes[n].count, 1u);
    ASSERT_LE(nodes[n].count, wide_tree_lanes);
    for (std::uint32_t lane = 0; lane < nodes[n].count; ++lane) {
      const WideNode::Lane& l = nodes[n].lanes[lane];
      if (l.is_box) {
        ASSERT_LT(l.number, boxes.size());
        ++seen[l.number];
        EXPECT_EQ(l.bounds.min.x, boxes[l.number].min.x);
        EXPECT_EQ(l.bounds.max.z, boxes[l.number].max.z);
        continue;
      }
      ASSERT_GT(l.number, n);
      ASSERT_LT(l.number, nodes.size());
      ASSERT_EQ(level[l.number], -1);
      level[l.number] = level[n] + 1;
      Extent below = nodes[l.number].lanes[0].bounds;
      for (std::uint32_t i = 1; i < nodes[l.number].count; ++i) {
        below = merged(below, nodes[l.number].lanes[i].bounds);
      }
      EXPECT_EQ(l.bounds.min.x, below.min.x);
      EXPECT_EQ(l.bounds.max.y, below.max.y);
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(boxes.size()));
}

TEST(WideTree, HoldsEveryBoxOnce) {
  Generator generator(8);
  for (const std::size_t count : {0, 1, 2, 7, 8, 9, 10, 64, 500, 5000}) {
    const std::vector<Extent> boxes = test::boxes(generator, count, 10, 2);
    const std::vector<WideNode> nodes = build_wide_tree(boxes);
    check(nodes, boxes);
    EXPECT_EQ(nodes.empty(), count == 0);
    if (count > 0 && count <= wide_tree_lanes) {
      EXPECT_EQ(nodes.size(), 1u);
    }
  }
}

TEST(WideTree, WhatIsLargeStandsInTheRoot) {
  std::vector<Extent> boxes;
  for (int i = 0; i < 200; ++i) boxes.push_back({{i * 2.0, 0, 0}, {i * 2.0 + 1, 1, 1}});
  boxes.insert(boxes.begin() + 77, Extent{{-1000, -1000, -1000}, {1000, 1000, 1000}});
  const std::vector<WideNode> nodes = build_wide_tree(boxes);
  check(nodes, boxes);
  const WideNode& root = nodes.front();
  EXPECT_TRUE(std::any_of(root.lanes, root.lanes + root.count, [](const WideNode::Lane& lane) {
    return lane.is_box && lane.number == 77;
  }));
}

TEST(WideTree, DepthIsBoundedWhereEveryCutTakesOneBoxOff) {
  // Each box holds all that come after it.
  std::vector<Extent> boxes;
  double half = 1e29;
  for (int i = 0; i < 3000; ++i, half *= 0.96) {
    boxes.push_back({{-half, -half, -half}, {half, half, half}});
  }
  check(build_wide_tree(boxes), boxes);
}

TEST(WideTree, TakesInfiniteEmptyAndEqualBoxes) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<Extent> boxes(40, {{0, 0, 0}, {1, 1, 1}});
  for (int i = 0; i < 40; ++i) {
    boxes.push_back({{-infinity, 0, 0}, {infinity, 0, infinity}});
    boxes.push_back({{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}});
    boxes.push_back({{2, 2, 2}, {2, 2, 2}});
  }
  check(build_wide_tree(boxes), boxes);
}

}  // namespace
}  // namespace navjit::bvh
