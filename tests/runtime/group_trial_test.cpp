#include "runtime/group_trial.hpp"

#include <gtest/gtest.h>

#include <random>

namespace navjit {
namespace {

/// Pairs of stretches, with so many steps on each side, of volumes that differ by more than the two
/// sides do.
Verdict stretches(GroupTrial& group, int pairs, int steps, double with, double without,
                  double now = 0.1) {
  std::mt19937_64 random(7);
  std::exponential_distribution<double> unit;
  Verdict verdict = Verdict::open;
  double made = 0, ns = 0;
  begin_stretch(group, made, ns);
  for (int i = 0; i < pairs && verdict == Verdict::open; ++i) {
    for (const bool shown : {true, false}) {
      group.shown = shown;
      for (int k = 0; k < steps; ++k) {
        ns += (k % 10 == 0 ? 5 : 1) * (shown ? with : without) * unit(random);
      }
      made += steps;
      record(group, made, ns);
    }
    verdict = decide(group, i + 1 == pairs ? now : 0.1);
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
  EXPECT_EQ(stretches(equal, 100, 1000, 100, 100, 2 * Trials::most_s), Verdict::stays);
}

TEST(GroupTrial, ALittleSlowerIsSeenInTheEnd) {
  GroupTrial slower = group();
  EXPECT_EQ(stretches(slower, 12, 2000, 107, 100), Verdict::open);
  GroupTrial later = group();
  EXPECT_EQ(stretches(later, 12, 2000, 107, 100, 2 * Trials::most_s), Verdict::goes);
}

TEST(GroupTrial, FewPairsDecideNothing) {
  GroupTrial few = group();
  EXPECT_EQ(stretches(few, 5, 400, 300, 100), Verdict::open);
  EXPECT_EQ(stretches(few, 1, 1, 300, 100, 2 * Trials::most_s), Verdict::stays)
      << "nor when the time is over";
}

TEST(GroupTrial, WhatTheRunDidBeforeAStretchDoesNotCount) {
  GroupTrial one = group();
  begin_stretch(one, 1000, 1e9);
  record(one, 1100, 1e9 + 5000);
  EXPECT_EQ(one.all.count, 100);
  EXPECT_EQ(one.with.mean(), 50);
}

TEST(GroupTrial, WhatTrialsSavedIsAShareOfAllThatTheySaw) {
  const auto trial = [](Verdict verdict, double with, double without) {
    Trial t;
    t.verdict = verdict;
    t.with = {10, 10 * with};
    t.without = {10, 10 * without};
    return t;
  };
  std::map<VolumeId, Trial> trials{{0, trial(Verdict::stays, 50, 100)},
                                   {2, trial(Verdict::goes, 300, 100)}};
  EXPECT_DOUBLE_EQ(saved_share(trials, {1000, 7, 4000}), 0.1);
  trials[2].verdict = Verdict::stays;
  EXPECT_LT(saved_share(trials, {1000, 7, 4000}), 0) << "passed though it was slower";
  trials[0].without = trials[2].without = {};
  EXPECT_EQ(saved_share(trials, {1000, 7, 4000}), 0) << "nothing was seen";
}

TEST(GroupTrial, TheRarestAreThoseBesideTheHottest) {
  EXPECT_EQ(rarest({{7, 10}, {8, 80}, {9, 6}, {10, 4}}, 0.75), (std::vector<VolumeId>{7, 9, 10}));
  EXPECT_EQ(rarest({{7, 50}, {8, 50}}, 0.75), std::vector<VolumeId>{});
  EXPECT_EQ(rarest({}, 0.75), std::vector<VolumeId>{});
}

TEST(GroupTrial, WhatIsUnprovedStaysOnlyWhereItIsFaster) {
  const auto after = [](Group kind, double with) {
    GroupTrial tried = group();
    tried.group = kind;
    return stretches(tried, 100, 1000, with, 100, 2 * Trials::most_s);
  };
  EXPECT_EQ(after(Group::unproved, 90), Verdict::stays);
  EXPECT_EQ(after(Group::unproved, 101.5), Verdict::goes);
  EXPECT_EQ(after(Group::all, 101.5), Verdict::stays) << "what switching costs";
  GroupTrial few = group();
  few.group = Group::unproved;
  EXPECT_EQ(stretches(few, 1, 1, 100, 300, 2 * Trials::most_s), Verdict::goes)
      << "nothing is known of it";
}

TEST(GroupTrial, AScenesLossMayBeChance) {
  const auto lost_by = [](double ticks, double count, double pairs) {
    Trial t;
    t.verdict = Verdict::goes;
    t.with.count = t.without.count = count;
    for (int i = 0; i < pairs; ++i) {
      t.lost.add({10, 10 * (ticks + (i % 2 == 0 ? 50 : -50))}, {10, 0});
    }
    return t;
  };
  EXPECT_TRUE(hardly_lost(lost_by(30, 1000, 16))) << "2.4 standard errors";
  EXPECT_FALSE(hardly_lost(lost_by(90, 1000, 16)));
  EXPECT_TRUE(hardly_lost(lost_by(90, 20, 16))) << "few steps";
  EXPECT_TRUE(hardly_lost(lost_by(90, 1000, 4))) << "few stretches";
  Trial won = lost_by(30, 1000, 16);
  won.verdict = Verdict::stays;
  EXPECT_FALSE(hardly_lost(won));
}

}  // namespace
}  // namespace navjit
