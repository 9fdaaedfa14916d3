#include "geometry/bvh/clustering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "tests/geometry/bvh/random_boxes.hpp"

namespace navjit::bvh {
namespace {

void expect_partition(const Clusters& clusters, std::size_t count, std::uint32_t capacity) {
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
    if (c + 1 < clusters.size()) {
      EXPECT_EQ(end - begin, static_cast<std::ptrdiff_t>(capacity));
    }
    EXPECT_TRUE(std::is_sorted(begin, end));
  }
}

double surface(std::span<const Extent> boxes, const Clusters& clusters) {
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

class EveryClustering : public testing::TestWithParam<Clustering> {
 protected:
  void expect_partition_of(std::span<const Extent> boxes, std::uint32_t capacity) {
    expect_partition(cluster(GetParam(), boxes, capacity), boxes.size(), capacity);
  }
};
std::string clustering_name(const testing::TestParamInfo<Clustering>& tested) {
  constexpr const char* names[] = {"surface", "k_means", "furthest"};
  return names[static_cast<int>(tested.param)];
}
INSTANTIATE_TEST_SUITE_P(Boxes, EveryClustering,
                         testing::Values(Clustering::surface, Clustering::k_means,
                                         Clustering::furthest),
                         clustering_name);

TEST_P(EveryClustering, IsAPartitionIntoFullClustersButTheLast) {
  test::Generator generator(5);
  for (const std::size_t count : {0, 1, 2, 7, 8, 9, 16, 17, 64, 65, 100, 512, 513, 10000}) {
    const std::vector<Extent> boxes = test::boxes(generator, count, 100, 10);
    for (const std::uint32_t capacity : {1u, 8u, 24u, 64u, 4096u}) {
      if (count == 10000 && capacity == 1) continue;  // as many means as boxes
      expect_partition_of(boxes, capacity);
    }
  }
}

TEST_P(EveryClustering, OfIdenticalAndOfHostileBoxes) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double huge = std::numeric_limits<double>::max();
  expect_partition_of(std::vector<Extent>(5000, {{0, 0, 0}, {1, 1, 1}}), 8);
  expect_partition_of(std::vector<Extent>(5000, {{-infinity, -infinity, -infinity},
                                                 {infinity, infinity, infinity}}),
                      8);
  expect_partition_of(std::vector<Extent>(1000, {{3, 3, 3}, {3, 3, 3}}), 16);
  std::vector<Extent> hostile;
  for (int i = 0; i < 500; ++i) {
    hostile.push_back({{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}});
    hostile.push_back({{-huge, -huge, -huge}, {huge, huge, huge}});
    hostile.push_back({{huge, huge, huge}, {huge, huge, huge}});
    hostile.push_back({{-infinity, 0, 0}, {1, 1, infinity}});
    hostile.push_back({{infinity, infinity, infinity}, {infinity, infinity, infinity}});
    hostile.push_back({{2, 2, 2}, {1, 1, 1}});
    hostile.push_back({{0.1 * i, 0, 0}, {0.1 * i + 1, 1, 1}});
  }
  expect_partition_of(hostile, 8);
  expect_partition_of(hostile, 512);
}

TEST_P(EveryClustering, DependsOnTheBoxesAlone) {
  test::Generator generator(6);
  const std::vector<Extent> boxes = test::boxes(generator, 2000, 100, 30);
  const Clusters a = cluster(GetParam(), boxes, 16), b = cluster(GetParam(), boxes, 16);
  EXPECT_EQ(a.order, b.order);
  EXPECT_EQ(a.begin, b.begin);
}

TEST_P(EveryClustering, FindsClumpsThatAreFarApart) {
  test::Generator generator(7);
  std::vector<Extent> boxes;
  for (int i = 0; i < 80; ++i) {  // box i belongs to clump i % 10
    const double x = 1000.0 * (i % 10) + test::uniform(generator, 0, 1);
    boxes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
  }
  const Clusters clusters = cluster(GetParam(), boxes, 8);
  ASSERT_EQ(clusters.size(), 10u);
  for (std::size_t i = 0; i < 80; ++i) {
    EXPECT_EQ(clusters.order[i] % 10, clusters.order[i / 8 * 8] % 10) << i;
  }
}

TEST(Clustering, FindsTheClustersOfAShuffledGrid) {
  // 16^3 cubes: 512 clusters of 2 x 2 x 2 would have the least surface.
  std::vector<Extent> boxes = test::grid(16, 1);
  test::Generator generator(7);
  for (std::size_t i = boxes.size(); i > 1; --i) {
    std::swap(boxes[i - 1], boxes[test::pick(generator, i)]);
  }
  const Clusters clusters = cluster_by_surface(boxes, 8);
  expect_partition(clusters, boxes.size(), 8);
  EXPECT_LE(surface(boxes, clusters), 1.01 * 512 * 24);
}

TEST(Clustering, CutsAStackIntoRuns) {
  std::vector<Extent> plates;
  for (int i = 0; i < 64; ++i) {
    const double z = (i * 37) % 64;
    plates.push_back({{-50, -50, z}, {50, 50, z + 1}});
  }
  const Clusters clusters = cluster_by_surface(plates, 8);
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
