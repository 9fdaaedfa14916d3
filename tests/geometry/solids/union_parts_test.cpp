// A union of many parts, found by their boxes eight at once, answers as its tree does, bit for bit.
#include "geometry/solids/union_parts.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "tests/support/random_solids.hpp"

namespace navjit {
namespace {

constexpr double tolerance = 1e-9;

using Union = kernels::AnyUnion<double>;

bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

Solid union_of(std::mt19937_64& random, int parts, double spread, double away) {
  const auto part = [&] {
    SolidFrame frame = random_frame(random);
    for (double& x : frame.translation) x = away + uniform(random, -spread, spread);
    return make_placed("part", random_primitive(random), frame);
  };
  Solid all = part();
  for (int i = 1; i < parts; ++i) {
    // Some are boxes that are not moved, which have no box around them.
    const bool plain = i % 7 == 3 && away == 0;
    const double h = uniform(random, 0.1, 1);
    all = make_union("all", all, plain ? make_box("plain", h, 2 * h, 1) : part());
  }
  return all;
}

const Union& shape_of(const Solid& solid) { return *static_cast<const Union*>(solid.shape.get()); }

struct Counted {
  int asked = 0, met = 0, held = 0, deep = 0;
};

/// Compares both forms for rays from all around, which continue where they meet the surface.
void compare(const Solid& solid, std::mt19937_64& random, double from, int rays, Counted& counted) {
  const Union& made = shape_of(solid);
  Union tree = made;
  tree.parts = nullptr;
  ASSERT_NE(made.parts, nullptr);
  ASSERT_TRUE(is_wide_enough(*made.parts, tolerance));
  const Vec3 low = solid.extent.min, high = solid.extent.max;
  for (int ray = 0; ray < rays; ++ray) {
    Vec3 target{uniform(random, low.x, high.x), uniform(random, low.y, high.y),
                uniform(random, low.z, high.z)};
    double d[3];
    for (double& x : d) x = uniform(random, -1, 1);
    if (ray % 4 == 1) d[ray / 4 % 3] = 0;
    if (ray % 8 == 2) d[0] = d[1] = 0;
    const double norm = std::hypot(d[0], d[1], d[2]);
    const Direction v = kernels::make_direction(d[0] / norm, d[1] / norm, d[2] / norm);
    Vec3 p = ray % 3 == 0 ? target : kernels::advance(target, v, -from);
    for (int i = 0; i < 12; ++i) {
      ++counted.asked;
      const bool within = contains(tree, p, v, tolerance);
      ASSERT_EQ(contains(made, p, v, tolerance), within) << ray << ' ' << i;
      const double in = distance_to_in(tree, p, v, tolerance);
      ASSERT_TRUE(same(distance_to_in(made, p, v, tolerance), in)) << ray << ' ' << i;
      const double out = distance_to_out(tree, p, v, tolerance);
      ASSERT_TRUE(same(distance_to_out(made, p, v, tolerance), out)) << ray << ' ' << i;
      counted.held += within ? 1 : 0;
      const double deep = safety_to_out(tree, p);
      ASSERT_TRUE(same(safety_to_out(made, p), deep)) << ray << ' ' << i;
      ASSERT_TRUE(same(safety_to_in(made, p), safety_to_in(tree, p))) << ray << ' ' << i;
      counted.deep += deep > 0 ? 1 : 0;
      const double on = within ? out : in;
      if (!(on < kernels::infinity<double>())) break;
      ++counted.met;
      // To the surface, and between two of them.
      p = kernels::advance(p, v, i % 3 == 2 ? on / 2 : on);
    }
  }
}

TEST(UnionParts, AnswerAsTheTree) {
  std::mt19937_64 random(21);
  Counted counted;
  for (const int parts : {5, 8, 9, 16, 17, 40, 64, 65, 200}) {
    const Solid all = union_of(random, parts, 3 * std::cbrt(parts), 0);
    compare(all, random, 30, 1500, counted);
  }
  EXPECT_GT(counted.met, 10000);
  EXPECT_GT(counted.held, 5000);
  EXPECT_GT(counted.deep, 2000);
}

TEST(UnionParts, AnswerAsTheTreeFromFarAwayAndFarFromTheOrigin) {
  std::mt19937_64 random(22);
  Counted counted;
  for (const double away : {0.0, 1e3, 1e5}) {
    for (const double from : {1e3, 1e6}) {
      compare(union_of(random, 30, 10, away), random, from, 1000, counted);
    }
  }
  EXPECT_GT(counted.met, 3000);
}

TEST(UnionParts, AreNotUsedWhereTheToleranceIsMoreThanTheirMargin) {
  std::mt19937_64 random(23);
  const Solid all = union_of(random, 20, 5, 0);
  const Union& made = shape_of(all);
  ASSERT_NE(made.parts, nullptr);
  EXPECT_FALSE(is_wide_enough(*made.parts, made.parts->margin));
  Union tree = made;
  tree.parts = nullptr;
  const double coarse = made.parts->margin;
  const Direction v = kernels::make_direction(0.6, 0.8, 0.0);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p{uniform(random, -8, 8), uniform(random, -8, 8), uniform(random, -8, 8)};
    ASSERT_EQ(contains(made, p, v, coarse), contains(tree, p, v, coarse));
    ASSERT_TRUE(same(distance_to_in(made, p, v, coarse), distance_to_in(tree, p, v, coarse)));
  }
}

TEST(UnionParts, AreForUnionsOfMany) {
  std::mt19937_64 random(24);
  EXPECT_EQ(shape_of(union_of(random, 4, 5, 0)).parts, nullptr);
  const Solid many = union_of(random, 20, 5, 0);
  ASSERT_NE(shape_of(many).parts, nullptr);
  EXPECT_EQ(shape_of(many).parts->operands.size(), 20U);
  EXPECT_EQ(shape_of(many).parts->blocks.size(), 3U);
  EXPECT_EQ(shape_of(many).parts->groups.size(), 1U);
}

}  // namespace
}  // namespace navjit
