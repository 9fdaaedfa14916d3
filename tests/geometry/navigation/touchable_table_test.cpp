// What is found in the table is the same as what would have been composed.
#include "geometry/navigation/touchable_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <string>

#include "geometry/navigation/generic.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

using tests::uniform;
using Force = GeometryOptions::Force;

/// A tree of so many levels, some of them turned; `breadth` daughters in each volume but the last.
std::shared_ptr<const World> tree(int levels, int breadth) {
  std::mt19937_64 random(4);
  World world;
  VolumeId inner = tests::add_volume(world, "leaf", make_box("leaf", 1, 1, 1));
  for (int level = 1; level < levels; ++level) {
    const double half = std::pow(3.0 * breadth, level);
    const std::string name = "level" + std::to_string(level);
    const VolumeId outer = tests::add_volume(world, name, make_box(name, half, half, half));
    for (int i = 0; i < breadth; ++i) {
      const Vec3 at{half * (2.0 * i / breadth - 0.9), uniform(random, -1, 1), 0.1};
      const Vec3 angles = i % 2 == 0 ? Vec3{0, 0, 0} : Vec3{0.1 * i, uniform(random, 0, 3), 0.2};
      tests::place(world, outer, inner, at, angles);
    }
    inner = outer;
  }
  world.top = inner;
  finish(world);
  return std::make_shared<const World>(std::move(world));
}

/// Compares every level bit by bit, and not only by value.
bool same_bits(const NavigationStack& a, const NavigationStack& b) {
  if (!identical(a, b)) return false;
  for (int i = 0; i <= a.depth; ++i) {
    const StackLevel &x = a.levels[i], &y = b.levels[i];
    if (std::memcmp(x.translation, y.translation, sizeof x.translation) != 0) return false;
    if ((x.rotation == nullptr) != (y.rotation == nullptr)) return false;
    // Of its own, or an outer level's: what was left tells them apart.
    if ((x.rotation == x.own_rotation) != (y.rotation == y.own_rotation)) return false;
    if (x.rotation != nullptr && std::memcmp(x.rotation, y.rotation, sizeof x.own_rotation) != 0) {
      return false;
    }
  }
  return true;
}

TEST(TouchableTable, HasTheBitsOfComposedFrames) {
  for (const auto& [levels, breadth] : {std::pair{1, 1}, {2, 5}, {4, 7}, {9, 3}}) {
    const auto world = tree(levels, breadth);
    const Geometry with(world), without(world, {Force::all});
    ASSERT_FALSE(with.touchables().empty());
    ASSERT_TRUE(without.touchables().empty());
    const TouchableId count = world->volumes[world->top].touchables;
    const auto a = std::make_unique<NavigationStack>(), b = std::make_unique<NavigationStack>();
    a->depth = b->depth = -1;
    std::mt19937_64 random(5);
    for (int i = 0; i < 3000; ++i) {
      // Anywhere, or near by.
      TouchableId to = random() % count;
      if (i % 3 != 0 && a->depth >= 0) {
        to = (a->levels[a->depth].touchable + random() % 3) % count;
      }
      generic::restore(with, *a, to);
      generic::restore(without, *b, to);
      ASSERT_EQ(a->levels[a->depth].touchable, to);
      ASSERT_TRUE(same_bits(*a, *b)) << to;
    }
  }
}

TEST(TouchableTable, OfTooManyTouchablesThereIsNone) {
  const auto world = tree(10, 5);  // 2441406
  ASSERT_GT(world->volumes[world->top].touchables, TouchableTable::most);
  const Geometry geometry(world);
  EXPECT_TRUE(geometry.touchables().empty());
  const auto stack = std::make_unique<NavigationStack>();
  stack->depth = -1;
  generic::restore(geometry, *stack, 2000000);
  EXPECT_EQ(stack->levels[stack->depth].touchable, 2000000U);
}

}  // namespace
}  // namespace navjit
