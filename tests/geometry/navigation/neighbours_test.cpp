#include "geometry/navigation/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "geometry/bvh/box_tree.hpp"
#include "geometry/solids/solid.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

using tests::uniform;

constexpr double tolerance = 1e-9;

bool in(const Extent& e, const Vec3& p) {
  return p.x >= e.min.x && p.x <= e.max.x && p.y >= e.min.y && p.y <= e.max.y && p.z >= e.min.z &&
         p.z <= e.max.z;
}

std::vector<Extent> random_boxes(std::mt19937_64& random, std::size_t count, double largest) {
  std::vector<Extent> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 c{uniform(random, -10, 10), uniform(random, -10, 10), uniform(random, -10, 10)};
    const Vec3 h{uniform(random, 0.01, largest), uniform(random, 0.01, largest),
                 uniform(random, 0.01, largest)};
    boxes.push_back({c - h, c + h});
  }
  return boxes;
}

TEST(NeighbourLists, ListWhateverSharesAPointWithADaughter) {
  std::mt19937_64 random(1);
  const Solid mother = make_box("mother", 12, 12, 12);
  std::size_t shared = 0;
  for (const std::size_t count : {2, 30, 500}) {
    const std::vector<Extent> boxes = random_boxes(random, count, count < 100 ? 2 : 0.8);
    const bvh::BoxTree tree(boxes, tolerance, bvh::default_method(count));
    const NeighbourLists with = find_neighbours(mother, boxes, &tree, tolerance);
    const NeighbourLists without = find_neighbours(mother, boxes, nullptr, tolerance);
    EXPECT_EQ(with.neighbours, without.neighbours);
    ASSERT_EQ(with.of.size(), count);
    for (int i = 0; i < 20000; ++i) {
      const auto k = static_cast<unsigned>(random() % count);
      const Extent& box = boxes[k];
      const Vec3 p{uniform(random, box.min.x, box.max.x), uniform(random, box.min.y, box.max.y),
                   i % 2 == 0 ? box.max.z : box.min.z};
      const NeighbourLists::Of* around = with.at(k, p);
      ASSERT_NE(around, nullptr);
      if (!around->listed()) continue;
      const auto near = with.neighbours_of(*around);
      EXPECT_TRUE(std::is_sorted(near.begin(), near.end(), std::greater<>()));
      for (std::uint32_t j = 0; j < count; ++j) {
        if (j == k || !in(boxes[j], p)) continue;
        ++shared;
        EXPECT_NE(std::find(near.begin(), near.end(), j), near.end());
      }
    }
  }
  EXPECT_GT(shared, 1000U);
}

TEST(NeighbourLists, TouchingDaughtersAreNeighboursAndThoseApartAreNot) {
  const Solid mother = make_box("mother", 10, 10, 10);
  const Extent boxes[] = {
      {{-5, -5, -5}, {0, 5, 5}}, {{0, -5, -5}, {5, 5, 5}}, {{5.001, -5, -5}, {6, 5, 5}}};
  const NeighbourLists s = find_neighbours(mother, boxes, nullptr, tolerance);
  const auto of = [&](unsigned k) {
    const auto near = s.neighbours_of(s.of[k]);
    return std::vector<std::uint32_t>(near.begin(), near.end());
  };
  EXPECT_EQ(of(0), std::vector<std::uint32_t>{1});
  EXPECT_EQ(of(1), std::vector<std::uint32_t>{0});
  EXPECT_TRUE(of(2).empty());
}

TEST(NeighbourLists, AreUnknownAwayFromTheDaughter) {
  const Solid mother = make_box("mother", 10, 10, 10);
  const Extent box{{-1, -1, -1}, {1, 1, 1}};
  const NeighbourLists s = find_neighbours(mother, std::span(&box, 1), nullptr, tolerance);
  EXPECT_NE(s.at(0, {1, 1, 1}), nullptr);
  EXPECT_NE(s.at(0, {1 + 1e-9, 0, 0}), nullptr);
  EXPECT_EQ(s.at(0, {1.001, 0, 0}), nullptr);
  EXPECT_EQ(s.at(1, {0, 0, 0}), nullptr);
  EXPECT_EQ(NeighbourLists{}.at(0, {0, 0, 0}), nullptr);
}

TEST(NeighbourLists, KnowWhatTheMotherContains) {
  const Extent box{{-1, -1, -1}, {1, 1, 1}};
  const auto contained = [&](const Solid& mother) {
    return find_neighbours(mother, std::span(&box, 1), nullptr, tolerance).of[0].mother_contains;
  };
  EXPECT_TRUE(contained(make_box("m", 1.001, 1.001, 1.001)));
  EXPECT_FALSE(contained(make_box("m", 1.001, 1, 1.001)));
  EXPECT_FALSE(contained(make_box("m", 1.001, 0.5, 1.001)));
  EXPECT_TRUE(contained(make_orb("m", 1.8)));
  EXPECT_FALSE(contained(make_orb("m", 1.7)));
  EXPECT_FALSE(contained(make_tube("m", 1, 5, 5, 0, 6.283185307179586)));
}

TEST(NeighbourLists, DoNotListTooMany) {
  // A large daughter with a hundred small ones along its face.
  const Solid mother = make_box("mother", 200, 200, 200);
  std::vector<Extent> boxes{{{-100, -100, -100}, {100, 100, 0}}};
  for (int i = 0; i < 100; ++i) boxes.push_back({{-100.0 + i, 0, 0}, {-99.5 + i, 1, 1}});
  const NeighbourLists s = find_neighbours(mother, boxes, nullptr, tolerance);
  EXPECT_FALSE(s.of[0].listed());
  EXPECT_TRUE(s.of[5].listed());
  EXPECT_EQ(s.of[5].count, 1);
}

}  // namespace
}  // namespace navjit
