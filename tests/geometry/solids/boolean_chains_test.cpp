// Chains of booleans are made anew as balanced trees: the same set of points, found much faster.
#include <gtest/gtest.h>

#include <deque>
#include <random>

#include "geometry/solids/solid.hpp"

namespace navjit {
namespace {

constexpr double tolerance = 1e-9;
constexpr int length = 40;

/// The operands are in a row, and some of them overlap.
Solid part(int i) {
  SolidFrame frame;
  frame.translation[0] = 3.0 * i + (i % 5 == 0 ? 1.3 : 0);
  frame.translation[1] = i % 2;
  frame.translation[2] = 0.25 * (i % 4);
  const Solid shape = i % 3 == 0   ? make_box("b", 1.1, 1.2, 2.5)
                      : i % 3 == 1 ? make_tube("t", 0.5, 1.4, 2.2, 0, 7)
                                   : make_orb("o", 1.45);
  return make_placed("p", shape, frame);
}

template <class Any>
const Any& shape_of(const Solid& solid) {
  return *static_cast<const Any*>(solid.shape.get());
}

int levels(const kernels::AnySolid<double>& solid) {
  if (solid.kind != SolidKind::union_of) return 0;
  const auto& u = *static_cast<const kernels::AnyUnion<double>*>(solid.shape);
  return 1 + std::max(levels(u.a.solid), levels(u.b.solid));
}

int parts(const kernels::AnySolid<double>& solid) {
  if (solid.kind != SolidKind::union_of) return 1;
  const auto& u = *static_cast<const kernels::AnyUnion<double>*>(solid.shape);
  return parts(u.a.solid) + parts(u.b.solid);
}

/// The chain as it is written, with one operand on each level, and without boxes.
template <class Any>
struct AsWritten {
  std::vector<Solid> operands;
  std::deque<Any> chain{};
  kernels::AnySolid<double> solid{};

  explicit AsWritten(std::vector<Solid> from, SolidKind kind) : operands(std::move(from)) {
    solid = operands[0].any();
    for (std::size_t i = 1; i < operands.size(); ++i) {
      chain.push_back({{solid, 0, {}, {}}, {operands[i].any(), 0, {}, {}}});
      solid = {kind, &chain.back()};
    }
  }
};

/// Compares answers about random rays, which continue where they meet the surface.
void expect_same(const kernels::AnySolid<double>& a, const kernels::AnySolid<double>& b) {
  std::mt19937_64 random(4);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int met = 0;
  for (int ray = 0; ray < 3000; ++ray) {
    Vec3 p{uniform(-10, 130), uniform(-2, 2), uniform(-2, 2)};
    Vec3 d{ray % 2 == 0 ? 1.0 : -1.0, uniform(-0.02, 0.02), uniform(-0.02, 0.02)};
    const double norm = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    const Direction v = kernels::make_direction(d.x / norm, d.y / norm, d.z / norm);
    for (int i = 0; i < 100; ++i) {
      ASSERT_EQ(inside(a, p, tolerance), inside(b, p, tolerance)) << ray << ' ' << i;
      ASSERT_EQ(contains(a, p, v, tolerance), contains(b, p, v, tolerance)) << ray << ' ' << i;
      ASSERT_DOUBLE_EQ(safety_to_in(a, p), safety_to_in(b, p));
      ASSERT_DOUBLE_EQ(safety_to_out(a, p), safety_to_out(b, p));
      const bool within = contains(b, p, v, tolerance);
      const double expected =
          within ? distance_to_out(b, p, v, tolerance) : distance_to_in(b, p, v, tolerance);
      const double made =
          within ? distance_to_out(a, p, v, tolerance) : distance_to_in(a, p, v, tolerance);
      if (expected == kernels::infinity<double>()) {
        ASSERT_EQ(made, expected);
        break;
      }
      ASSERT_NEAR(made, expected, 1e-10 * (1 + expected)) << ray << ' ' << i;
      ++met;
      p = kernels::advance(p, v, expected);
    }
  }
  EXPECT_GT(met, 10000);
}

TEST(BooleanChains, AUnionOfManyIsABalancedTree) {
  std::vector<Solid> operands{part(0)};
  Solid all = part(0);
  for (int i = 1; i < length; ++i) {
    operands.push_back(part(i));
    // From either side.
    all = i % 2 == 0 ? make_union("u", all, part(i)) : make_union("u", part(i), all);
  }
  EXPECT_EQ(all.name, "u");
  EXPECT_EQ(parts(all.any()), length);
  EXPECT_LE(levels(all.any()), 6);
  const AsWritten<kernels::AnyUnion<double>> written(operands, SolidKind::union_of);
  expect_same(all.any(), written.solid);
}

TEST(BooleanChains, ManyHolesAreCutAsOneUnion) {
  SolidFrame frame;
  frame.translation[0] = 60;
  const Solid plate = make_placed("plate", make_box("b", 63, 4, 2), frame);
  std::vector<Solid> operands{plate};
  Solid all = plate;
  for (int i = 0; i < length; ++i) {
    operands.push_back(part(i));
    all = make_subtraction("holes", all, part(i));
  }
  EXPECT_EQ(all.name, "holes");
  ASSERT_EQ(all.kind, SolidKind::subtraction_of);
  const auto& s = shape_of<kernels::AnySubtraction<double>>(all);
  EXPECT_EQ(s.a.solid.kind, SolidKind::placed) << "the plate itself";
  EXPECT_EQ(parts(s.b.solid), length);
  EXPECT_LE(levels(s.b.solid), 6);
  EXPECT_EQ(all.extent.min.x, plate.extent.min.x);
  EXPECT_EQ(all.extent.max.x, plate.extent.max.x);
  const AsWritten<kernels::AnySubtraction<double>> written(operands, SolidKind::subtraction_of);
  expect_same(all.any(), written.solid);
}

TEST(BooleanChains, PartsInOnePlaceAreATreeToo) {
  Solid all = make_orb("o", 1);
  for (int i = 1; i < 100; ++i) all = make_union("u", all, make_orb("o", 1 + 0.01 * i));
  EXPECT_EQ(parts(all.any()), 100);
  EXPECT_LE(levels(all.any()), 7);
}

}  // namespace
}  // namespace navjit
