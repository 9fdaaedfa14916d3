// Compares rays as two engines took them.
#include "bench/agreement.hpp"

#include <gtest/gtest.h>

namespace navjit::bench {
namespace {

constexpr double tolerance = 1e-6;

const std::vector<Passed> ray{{"Hall", 10}, {"Wall", 1}, {"Hall", 20}};

TEST(Agreement, OfTheSameStepsHolds) { EXPECT_TRUE(agree(ray, ray, tolerance)); }

TEST(Agreement, HoldsWithinTheTolerance) {
  EXPECT_TRUE(
      agree(ray, std::vector<Passed>{{"Hall", 10 + 5e-7}, {"Wall", 1}, {"Hall", 20}}, tolerance));
  EXPECT_FALSE(
      agree(ray, std::vector<Passed>{{"Hall", 10 + 2e-6}, {"Wall", 1}, {"Hall", 20}}, tolerance));
}

TEST(Agreement, AddsUpWhatLengthsDiffer) {
  // Each by less than the tolerance, the last boundary by more.
  const std::vector<Passed> longer{{"Hall", 10 + 8e-7}, {"Wall", 1 + 8e-7}, {"Hall", 20}};
  EXPECT_FALSE(agree(ray, longer, tolerance));
}

TEST(Agreement, NeedsTheSameVolumes) {
  EXPECT_FALSE(agree(ray, std::vector<Passed>{{"Hall", 10}, {"Gap", 1}, {"Hall", 20}}, tolerance));
  EXPECT_FALSE(agree(ray, std::vector<Passed>{{"Hall", 10}, {"Wall", 1}}, tolerance));
  EXPECT_FALSE(agree(ray, std::vector<Passed>{{"Hall", 31}}, tolerance));
  EXPECT_FALSE(agree(ray, {}, tolerance));
}

TEST(Agreement, DoesNotDependOnStepsOfNoLength) {
  const std::vector<Passed> more{{"Wall", 1e-9}, {"Hall", 10}, {"Gap", 0},
                                 {"Wall", 1},    {"Hall", 20}, {"Gap", 1e-7}};
  EXPECT_TRUE(agree(ray, more, tolerance));
  EXPECT_TRUE(agree({}, {}, tolerance));
}

TEST(Agreement, KeepsTheLengthOfWhatIsLeftOut) {
  const std::vector<Passed> steps{{"A", 1e-7}, {"B", 2}, {"C", 1e-7}};
  const auto kept = without_short_steps(steps, tolerance);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].volume, "B");
  EXPECT_DOUBLE_EQ(kept[0].length, 2 + 2e-7);
}

}  // namespace
}  // namespace navjit::bench
