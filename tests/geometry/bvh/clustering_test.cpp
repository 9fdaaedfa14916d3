#include "geometry/bvh/clustering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/geometry/bvh/random_boxes.hpp"

namespace navjit::bvh {
namespace {

void expect_partition(const Clustering& clusters, std::size_t count, std::uint32_t capacity) {
  EXPECT_EQ(clusters.size(), (count + capacity - 1) / capacity);
  ASSERT_EQ(clusters.begin.front(), 0u);
  ASSERT_EQ(clusters.begin.back(), count);
  std::vector<std::uint32_t> seen = clusters.order;
  std::sort(seen.begin(), seen.end());
  for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(seen[i], i);
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const auto begin = clusters.order.begin() + clusters.begin[c];
    const auto end = clusters.order.begin() + clusters.begin[c + 1];
    EXPECT_GT(end - begin, 0);
    EXPECT_LE(end - begin, static_cast<std::ptrdiff_t>(capacity));
    EXPECT_TRUE(std::is_sorted(begin, end));
  }
}

double surface(std::span<const Extent> boxes, const Clustering& clusters) {
  double sum = 0;
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    Extent all = boxes[clusters.order[clusters.begin[c]]];
    for (std::uint32_t i = clusters.begin[c]; i < clusters.begin[c + 1]; ++i) {
      const Extent& box = boxes[clusters.order[i]];
      all.min = {std::min(all.min.x, box.min.x), std::min(all.min.y, box.min.y),
                 std::min(all.min.z, box.min.z)};
      all.max = {std::max(all.max.x, box.max.x), std::max(all.max.y, box.max.y),
                 std::max(all.max.z, box.max.z)};
    }
    const double x = all.max.x - all.min.x, y = all.max.y - all.min.y, z = all.max.z - all.min.z;
    sum += 2 * (x * y + y * z + z * x);
  }
  return sum;
}

TEST(Clustering, IsAPartitionIntoTheFewestClusters) {
  test::Generator generator(5);
  for (const std::size_t count : {0, 1, 2, 7, 8, 9, 16, 17, 100, 1000, 10000}) {
    const std::vector<Extent> boxes = test::boxes(generator, count, 100, 10);
    for (const std::uint32_t capacity : {1u, 8u, 24u, 64u}) {
      expect_partition(cluster_by_surface(boxes, capacity), count, capacity);
    }
  }
}

TEST(Clustering, OfIdenticalAndOfUnboundedBoxes) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::vector<Extent> same(5000, {{0, 0, 0}, {1, 1, 1}});
  expect_partition(cluster_by_surface(same, 8), same.size(), 8);
  const std::vector<Extent> unbounded(
      5000, {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}});
  expect_partition(cluster_by_surface(unbounded, 8), unbounded.size(), 8);
  const std::vector<Extent> points(1000, {{3, 3, 3}, {3, 3, 3}});
  expect_partition(cluster_by_surface(points, 16), points.size(), 16);
}

TEST(Clustering, DependsOnTheBoxesAlone) {
  test::Generator generator(6);
  const std::vector<Extent> boxes = test::boxes(generator, 2000, 100, 30);
  const Clustering a = cluster_by_surface(boxes, 16), b = cluster_by_surface(boxes, 16);
  EXPECT_EQ(a.order, b.order);
  EXPECT_EQ(a.begin, b.begin);
}

TEST(Clustering, FindsTheClustersOfAShuffledGrid) {
  // 16^3 cubes: 512 clusters of 2 x 2 x 2 would have the least surface.
  std::vector<Extent> boxes = test::grid(16, 1);
  test::Generator generator(7);
  for (std::size_t i = boxes.size(); i > 1; --i) {
    std::swap(boxes[i - 1], boxes[test::pick(generator, i)]);
  }
  const Clustering clusters = cluster_by_surface(boxes, 8);
  expect_partition(clusters, boxes.size(), 8);
  EXPECT_LE(surface(boxes, clusters), 1.01 * 512 * 24);
}

TEST(Clustering, CutsAStackIntoRuns) {
  std::vector<Extent> plates;
  for (int i = 0; i < 64; ++i) {
    const double z = (i * 37) % 64;
    plates.push_back({{-50, -50, z}, {50, 50, z + 1}});
  }
  const Clustering clusters = cluster_by_surface(plates, 8);
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    double low = 64, high = 0;
    for (std::uint32_t i = clusters.begin[c]; i < clusters.begin[c + 1]; ++i) {
      low = std::min(low, plates[clusters.order[i]].min.z);
      high = std::max(high, plates[clusters.order[i]].max.z);
    }
    EXPECT_EQ(high - low, 8);
  }
}

}  // namespace
}  // namespace navjit::bvh
