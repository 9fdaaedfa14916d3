// The size of booleans, known before they are made.
#include "geometry/solids/boolean_size.hpp"

#include <gtest/gtest.h>

namespace navjit {
namespace {

BooleanSize chained(Boolean kind, std::size_t solids, bool moved = false) {
  BooleanSize size;
  for (std::size_t i = 1; i < solids; ++i) size = size_of(kind, size, moved, {});
  return size;
}

TEST(BooleanSize, ChainsHaveFewLevels) {
  EXPECT_EQ(chained(Boolean::join, 1).depth, 1U);
  EXPECT_EQ(chained(Boolean::join, 2).depth, 2U);
  EXPECT_EQ(chained(Boolean::join, 1024).depth, 11U);
  EXPECT_EQ(chained(Boolean::join, 1024).links, 1024U);
  EXPECT_EQ(chained(Boolean::join, 1024).parts, 1024U);
  // One solid, less a union of 1024.
  EXPECT_EQ(chained(Boolean::cut, 1025).depth, 12U);
  EXPECT_EQ(chained(Boolean::meet, 100).depth, 100U);
  EXPECT_EQ(chained(Boolean::join, 100, true).depth, 8U);
  EXPECT_EQ(chained(Boolean::cut, 100, true).depth, 100U);
}

TEST(BooleanSize, ChainsGoOnInEitherOperandOfAUnion) {
  const BooleanSize holes = chained(Boolean::join, 64), plate = chained(Boolean::cut, 33);
  EXPECT_EQ(size_of(Boolean::join, holes, false, holes).depth, 8U);
  EXPECT_EQ(size_of(Boolean::cut, {}, false, holes).depth, 8U);
  // 32 holes and 64 more.
  EXPECT_EQ(size_of(Boolean::cut, plate, false, holes).depth, 9U);
  EXPECT_EQ(size_of(Boolean::cut, plate, false, plate).depth, 14U);
  EXPECT_EQ(size_of(Boolean::join, plate, false, plate).depth, 1 + plate.depth);
}

TEST(BooleanSize, WhatIsTooLargeIsSaid) {
  const BooleanLimits limits{10, 100, 80, "SomeLimits", "do otherwise"};
  std::size_t in_all = 0;
  EXPECT_EQ(excess(chained(Boolean::join, 80), limits, in_all), "");
  EXPECT_EQ(in_all, 80U);
  EXPECT_EQ(excess(chained(Boolean::meet, 11), limits, in_all),
            "booleans are nested more than 10 deep; split the solid, or raise "
            "SomeLimits::max_solid_depth");
  EXPECT_EQ(excess(chained(Boolean::join, 101), limits, in_all),
            "more than 100 booleans are chained; do otherwise, or raise "
            "SomeLimits::max_solid_chain");
  EXPECT_EQ(excess(chained(Boolean::join, 81), limits, in_all),
            "the boolean has more than 80 parts; split the solid, or raise "
            "SomeLimits::max_solid_parts");
  in_all = 5'000'000;
  EXPECT_EQ(excess({}, limits, in_all),
            "the file's booleans are made of too many parts in all; do otherwise");
}

}  // namespace
}  // namespace navjit
