#include "runtime/group_trial.hpp"

#include <gtest/gtest.h>

#include <random>

namespace navjit {
namespace {

/// Pairs of stretches with so many steps of each side, of volumes that differ by more than the
/// sides do.
Verdict stretches(GroupTrial& group, int pairs, int steps, double with, double without,
                  double now = 0.1) {
  std::mt19937_64 random(7);
  std::exponential_distribution<double> unit;
  Verdict verdict = Verdict::open;
  for (int i = 0; i < pairs && verdict == Verdict::open; ++i) {
    for (const bool shown : {true, false}) {
      group.shown = shown;
      for (int k = 0; k < steps; ++k) {
        record(group, (k % 10 == 0 ? 5 : 1) * (shown ? with : without) * unit(random));
      }
    }
    verdict = decide(group, now);
  }
  return verdict;
}

GroupTrial group() {
  GroupTrial group;
  group.members = {1, 2, 3};
  return group;
}

TEST(GroupTrial, WhatSlowsTheRunGoesAndWhatSpeedsItStays) {
  GroupTrial slower = group(), faster = group();
  EXPECT_EQ(stretches(slower, 400, 400, 110, 100), Verdict::goes);
  EXPECT_EQ(stretches(faster, 400, 400, 100, 110), Verdict::stays);
}

TEST(GroupTrial, WhatMakesNoDifferenceStays) {
  GroupTrial equal = group();
  EXPECT_EQ(stretches(equal, 2000, 100, 100, 100), Verdict::stays);
}

TEST(GroupTrial, FewStepsDecideNothing) {
  GroupTrial few = group();
  EXPECT_EQ(stretches(few, 5, 400, 300, 100), Verdict::open);
  EXPECT_EQ(stretches(few, 1, 1, 300, 100, 2 * Trials::most_s), Verdict::stays)
      << "nor when the time is over";
}

TEST(GroupTrial, AnInterruptionIsNoMerit) {
  GroupTrial interrupted = group();
  std::mt19937_64 random(3);
  std::exponential_distribution<double> unit;
  Verdict verdict = Verdict::open;
  for (int i = 0; i < 200 && verdict == Verdict::open; ++i) {
    for (const bool shown : {true, false}) {
      interrupted.shown = shown;
      for (int k = 0; k < 400; ++k) record(interrupted, (shown ? 90 : 100) * unit(random));
      if (shown && i == 1) record(interrupted, 1e7);
    }
    verdict = decide(interrupted, 0.1);
  }
  EXPECT_EQ(verdict, Verdict::stays);
}

TEST(GroupTrial, NothingIsRecordedWhereNothingIsTried) {
  GroupTrial none;
  record(none, 100);
  EXPECT_EQ(none.samples, 0);
}

TEST(GroupTrial, TheRarestAreThoseBesideTheHottest) {
  EXPECT_EQ(rarest({{7, 10}, {8, 80}, {9, 6}, {10, 4}}, 0.75), (std::vector<VolumeId>{7, 9, 10}));
  EXPECT_EQ(rarest({{7, 50}, {8, 50}}, 0.75), std::vector<VolumeId>{});
  EXPECT_EQ(rarest({}, 0.75), std::vector<VolumeId>{});
}

}  // namespace
}  // namespace navjit
