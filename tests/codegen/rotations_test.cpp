#include "codegen/data/rotations.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace navjit::codegen {
namespace {

Daughter turned_by(double cosine, double sine) {
  Daughter d{};
  const double r[9] = {cosine, sine, 0, -sine, cosine, 0, 0, 0, 1};
  std::copy_n(r, 9, d.transformation.rotation);
  d.transformation.rotated = true;
  return d;
}

TEST(Rotations, EqualOnesAreKeptOnce) {
  Arena arena;
  Rotations rotations(arena);
  const Daughter a = turned_by(0.6, 0.8), b = turned_by(0.6, 0.8), c = turned_by(0.8, 0.6);
  const double* of_a = rotations.of(a);
  ASSERT_NE(of_a, nullptr);
  EXPECT_TRUE(std::equal(of_a, of_a + 9, a.transformation.rotation));
  EXPECT_EQ(rotations.of(b), of_a);
  const double* of_c = rotations.of(c);
  EXPECT_NE(of_c, of_a);
  EXPECT_TRUE(std::equal(of_c, of_c + 9, c.transformation.rotation));
}

TEST(Rotations, ThereIsNoneWithoutARotation) {
  Arena arena;
  Rotations rotations(arena);
  EXPECT_EQ(rotations.of(Daughter{}), nullptr);
}

}  // namespace
}  // namespace navjit::codegen
