// Which steps a navigator records for the specialiser.
#include "navjit/detail/profile.hpp"

#include <gtest/gtest.h>

namespace navjit {
namespace {

/// Makes so many steps and records those that are due; returns how many were.
int record_due(Profile& profile, int steps) {
  int recorded = 0;
  for (int step = 0; step < steps; ++step) {
    profile.count(0);
    if (!profile.due()) continue;
    ++recorded;
    profile.record(Sample{0, 0, {}, {}, 0});
  }
  return recorded;
}
int take_all(Profile& profile) {
  int taken = 0;
  for (Sample sample; profile.take(sample);) ++taken;
  return taken;
}

TEST(Profile, RecordsOneStepInSixtyOneForAReaderThatKeepsUp) {
  Profile profile(1);
  int recorded = 0, taken = 0;
  for (int look = 0; look < 20; ++look) {
    recorded += record_due(profile, 10000);
    taken += take_all(profile);
  }
  EXPECT_EQ(recorded, taken);
  EXPECT_NEAR(recorded, 200000 / static_cast<int>(Profile::period), 1);
  EXPECT_EQ(profile.steps(0), 200000);
}

TEST(Profile, RecordsHardlyAnyThatNobodyReads) {
  Profile profile(1);
  const int kept = record_due(profile, 100 * 1024);
  const int steps = 10'000'000;
  EXPECT_LE(record_due(profile, steps), steps / static_cast<int>(Profile::period_when_full) + 1);
  EXPECT_EQ(take_all(profile), 1024);
  EXPECT_GE(kept, 1024);
  // And as many as ever soon after somebody does.
  record_due(profile, Profile::period_when_full);
  EXPECT_GT(record_due(profile, 1000 * static_cast<int>(Profile::period)), 990);
}

}  // namespace
}  // namespace navjit
