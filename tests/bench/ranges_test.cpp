// Which numbers benchmarks take.
#include "bench/ranges.hpp"

#include <gtest/gtest.h>

#include <string>

namespace navjit::bench {
namespace {

bool takes(const CLI::Range& range, const std::string& text) { return range(text).empty(); }

TEST(Ranges, LeaveOutWhatMeasuresNothing) {
  for (const char* none : {"0", "-3", "x", ""}) {
    EXPECT_FALSE(takes(range_of_counts(), none)) << none;
    EXPECT_FALSE(takes(range_of_repetitions(), none)) << none;
    EXPECT_FALSE(takes(range_of_steps(), none)) << none;
    EXPECT_FALSE(takes(range_of_seconds(), none)) << none;
  }
}

TEST(Ranges, TakeWhatIsMeasured) {
  EXPECT_TRUE(takes(range_of_counts(), "1"));
  EXPECT_TRUE(takes(range_of_counts(), "500000"));
  EXPECT_TRUE(takes(range_of_repetitions(), "1"));
  EXPECT_TRUE(takes(range_of_steps(), "100"));
  EXPECT_TRUE(takes(range_of_seconds(), "0.5"));
}

TEST(Ranges, LeaveOutWhatNoMachineHolds) {
  EXPECT_FALSE(takes(range_of_counts(), "99999999999999"));
  EXPECT_FALSE(takes(range_of_steps(), "300000000"));
  EXPECT_FALSE(takes(range_of_repetitions(), "300000000"));
}

}  // namespace
}  // namespace navjit::bench
