#include "geometry/navigation/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "geometry/bvh/box_tree.hpp"
#include "geometry/solids/extent.hpp"
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

TEST(NeighbourLists, KnowWhatTheMotherContainsOfFlatBoxes) {
  // The ball around a plate reaches far out of what holds the plate.
  const auto contained = [&](const Solid& mother, const Extent& box) {
    return find_neighbours(mother, std::span(&box, 1), nullptr, tolerance).of[0].mother_contains;
  };
  const Extent plate{{-6, -6, -0.5}, {6, 6, 0.5}};
  const Solid vessel = make_tube("m", 0, 12, 1, 0, 6.283185307179586);
  EXPECT_TRUE(contained(vessel, plate));
  EXPECT_FALSE(contained(vessel, {{-6, -6, -0.5}, {9, 9, 0.5}})) << "its corners stick out";
  EXPECT_FALSE(contained(vessel, {{-6, -6, -0.5}, {6, 6, 1}})) << "it is flush with the end";
  const Solid shell = make_subtraction("m", vessel, make_box("b", 1, 1, 0.75));
  EXPECT_FALSE(contained(shell, plate)) << "its middle is cut out";
  EXPECT_TRUE(contained(shell, {{2, -6, -0.5}, {6, 6, 0.5}}));
}

TEST(NeighbourLists, ClaimOfMothersNoMoreThanTheyContain) {
  std::mt19937_64 random(3);
  const Solid mothers[] = {
      make_tube("m", 2, 10, 10, 0, 6.283185307179586), make_orb("m", 10),
      make_subtraction("m", make_box("a", 10, 10, 10), make_orb("b", 3)),
      make_union("m", make_box("a", 10, 4, 4), make_tube("b", 0, 6, 9, 0, 6.283185307179586))};
  std::size_t claimed = 0, by_parts = 0;
  for (const Solid& mother : mothers) {
    for (int i = 0; i < 3000; ++i) {
      const Extent box = random_boxes(random, 1, i % 2 == 0 ? 6 : 1)[0];
      if (!holds_deep(mother, box, 1e-3)) continue;
      ++claimed;
      const Vec3 c = 0.5 * (box.min + box.max), h = 0.5 * (box.max - box.min);
      by_parts += safety_to_out(mother.any(), c) <= std::hypot(h.x, h.y, h.z) ? 1 : 0;
      for (int k = 0; k < 64; ++k) {
        const Vec3 p{uniform(random, box.min.x, box.max.x), uniform(random, box.min.y, box.max.y),
                     uniform(random, box.min.z, box.max.z)};
        ASSERT_EQ(inside(mother.any(), p, tolerance), Side::inside) << mother.name << ' ' << i;
      }
    }
  }
  EXPECT_GT(claimed, 1000U);
  EXPECT_GT(by_parts, 300U);
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

/// Boxes of edge 1 in a lattice; each touches up to 26 others.
std::vector<Extent> lattice(int edge) {
  std::vector<Extent> boxes;
  for (int i = 0; i < edge; ++i) {
    for (int j = 0; j < edge; ++j) {
      for (int k = 0; k < edge; ++k) {
        const Vec3 low{i + 1.0 / 3, j + 1.0 / 7, k - 1e3};
        boxes.push_back({low, low + Vec3{1, 1, 1}});
      }
    }
  }
  return boxes;
}

TEST(NeighbourLists, BlocksLeaveOutNoNeighbourThatHoldsThePoint) {
  std::mt19937_64 random(2);
  const Solid mother = make_box("mother", 1e4, 1e4, 1e4);
  const std::vector<Extent> boxes = lattice(6);
  const NeighbourLists s = find_neighbours(mother, boxes, nullptr, tolerance);
  std::size_t held = 0, asked = 0, all = 0;
  for (int i = 0; i < 50000; ++i) {
    const auto k = static_cast<unsigned>(random() % boxes.size());
    const NeighbourLists::Of& of = s.of[k];
    ASSERT_TRUE(of.listed());
    ASSERT_NE(of.block, NeighbourLists::Of::no_block);
    const Extent& box = boxes[k];
    // On a face, or up to the tolerance off it: where neighbours hold it, or lose it.
    Vec3 p{uniform(random, box.min.x, box.max.x), uniform(random, box.min.y, box.max.y),
           uniform(random, box.min.z, box.max.z)};
    double* const across[3] = {&p.x, &p.y, &p.z};
    *across[random() % 3] =
        boxes[random() % boxes.size()].max.x + uniform(random, -1, 1) * tolerance;
    p.x = std::clamp(p.x, box.min.x, box.max.x);
    p.y = std::clamp(p.y, box.min.y, box.max.y);
    p.z = std::clamp(p.z, box.min.z, box.max.z);
    const auto near = s.neighbours_of(of);
    const auto holds = [&](std::uint32_t j) { return in(inflated(boxes[j], tolerance), p); };
    const auto first = std::find_if(near.begin(), near.end(), holds);
    const int found = kernels::first_around(s.blocks.data() + of.block, near.data(), of.count, p,
                                            [&](unsigned j) { return ++asked, holds(j); });
    EXPECT_EQ(found, first == near.end() ? -1 : static_cast<int>(*first));
    held += first != near.end() ? 1 : 0;
    all += static_cast<std::size_t>(first - near.begin()) + (first != near.end() ? 1 : 0);
  }
  EXPECT_GT(held, 10000U);
  // What the blocks are for.
  EXPECT_LT(3 * asked, all);
}

TEST(NeighbourLists, FewNeighboursHaveNoBlock) {
  const Solid mother = make_box("mother", 10, 10, 10);
  std::vector<Extent> boxes;
  for (int i = 0; i < 5; ++i) boxes.push_back({{-5.0 + i, -1, -1}, {-4.0 + i, 1, 1}});
  const NeighbourLists s = find_neighbours(mother, boxes, nullptr, tolerance);
  for (const NeighbourLists::Of& of : s.of) EXPECT_EQ(of.block, NeighbourLists::Of::no_block);
  EXPECT_TRUE(s.blocks.empty());
}

TEST(NeighbourLists, AreNotMadeWhereNoCacheHoldsThem) {
  const Solid mother = make_box("mother", 30, 30, 30);
  const std::vector<Extent> few = lattice(10), many = lattice(20);
  const bvh::BoxTree tree_of_few(few, tolerance, bvh::default_method(few.size()));
  const bvh::BoxTree tree_of_many(many, tolerance, bvh::default_method(many.size()));
  const NeighbourLists listed = find_neighbours(mother, few, &tree_of_few, tolerance);
  EXPECT_EQ(listed.of.size(), few.size());
  EXPECT_GT(listed.bytes(), few.size() * 26 * sizeof(std::uint32_t) / 2);
  const NeighbourLists none = find_neighbours(mother, many, &tree_of_many, tolerance);
  EXPECT_EQ(none.bytes(), 0U);
  EXPECT_EQ(none.at(0, {0.5, 0.5, 0.5}), nullptr);
}

/// Boxes in a row; each touches two others.
std::vector<Extent> row(std::size_t count) {
  std::vector<Extent> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<double>(i);
    boxes.push_back({{x, -1, -1}, {x + 1, 1, 1}});
  }
  return boxes;
}

TEST(NeighbourLists, OfFewNeighboursAreMadeUpToALimit) {
  const auto lists = [](std::size_t count) {
    const std::vector<Extent> boxes = row(count);
    const bvh::BoxTree tree(boxes, tolerance, bvh::default_method(count));
    const auto half = static_cast<double>(count);
    return find_neighbours(make_box("mother", half, 9, 9), boxes, &tree, tolerance);
  };
  const NeighbourLists some = lists(20'000), more = lists(30'000);
  EXPECT_EQ(some.of.size(), 20'000U);
  EXPECT_TRUE(some.are_near());
  ASSERT_EQ(more.of.size(), 30'000U);
  EXPECT_FALSE(more.are_near());
  EXPECT_EQ(more.at(7, {7.5, 0, 1})->count, 2U);
  EXPECT_TRUE(lists(60'000).of.empty());
}

}  // namespace
}  // namespace navjit
