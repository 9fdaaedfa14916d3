// Means without times that were interrupted.
#include "bench/interrupted.hpp"

#include <gtest/gtest.h>

namespace navjit::bench {
namespace {

TEST(Interrupted, TimesThatAreMerelySlowCount) {
  // One time in ten is slow; to leave out the slowest few would flatter.
  EXPECT_DOUBLE_EQ(mean_uninterrupted({1, 1, 1, 1, 1, 1, 1, 1, 1, 11}), 2);
}

TEST(Interrupted, TimesFarAboveTheMedianAreLeftOut) {
  EXPECT_DOUBLE_EQ(mean_uninterrupted({1, 3, 1000, 2, 2}), 2);
}

TEST(Interrupted, AClockTooCoarseLeavesOutNothing) {
  EXPECT_DOUBLE_EQ(mean_uninterrupted({0, 0, 0, 4}), 1);
}

TEST(Interrupted, NoTimesHaveNoMean) { EXPECT_EQ(mean_uninterrupted({}), 0); }

}  // namespace
}  // namespace navjit::bench
