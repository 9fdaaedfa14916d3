#include "runtime/trials.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "navjit/navigator.hpp"

namespace navjit {
namespace {

const kernels::DispatchEntry before{}, candidate{}, other{};

struct Steps {
  std::mt19937_64 random{5};

  /// Pairs of stretches with so many steps of each side, exponential about these means, and
  /// longer in some stretches than in others. The last decisions.
  std::vector<Trials::Of> make(Trials& trials, const std::vector<VolumeId>& volumes, int pairs,
                               int steps, double with, double without, double now = 0.1) {
    std::exponential_distribution<double> unit;
    std::vector<Trials::Of> decided;
    for (int i = 0; i < pairs; ++i) {
      const double phase = i % 3 == 0 ? 2 : 1;
      for (const VolumeId volume : volumes) {
        for (int k = 0; k < steps; ++k) {
          trials.record(volume, &candidate, phase * with * unit(random));
          trials.record(volume, &before, phase * without * unit(random));
        }
      }
      for (const auto& d : trials.decide(now)) decided.push_back(d);
    }
    return decided;
  }
};

Trial trial() { return {&candidate, &before}; }

TEST(Trials, WhatIsSlowerGoesAndWhatIsFasterStays) {
  Trials trials;
  Steps steps;
  trials.begin(1, trial(), 0);
  trials.begin(2, trial(), 0);
  const auto slower = steps.make(trials, {1}, 40, 100, 130, 100);
  const auto faster = steps.make(trials, {2}, 40, 100, 100, 130);
  ASSERT_EQ(slower.size(), 1U) << "decided once";
  EXPECT_EQ(slower[0].volume, 1U);
  EXPECT_EQ(slower[0].trial->verdict, Verdict::goes);
  ASSERT_EQ(faster.size(), 1U);
  EXPECT_EQ(faster[0].volume, 2U);
  EXPECT_EQ(faster[0].trial->verdict, Verdict::stays);
  EXPECT_FALSE(trials.open());
}

TEST(Trials, FewStepsDecideNothingUntilTheTrialIsOver) {
  Trials trials;
  Steps steps;
  trials.begin(1, trial(), 0);
  EXPECT_TRUE(steps.make(trials, {1}, 3, 100, 300, 100).empty()) << "few pairs";
  EXPECT_TRUE(trials.open());
  EXPECT_EQ(steps.make(trials, {1}, 1, 10, 300, 100, 2 * Trials::most_s).size(), 1U);
  EXPECT_FALSE(trials.open());
}

TEST(Trials, APhaseThatOneSideMeetsMoreOftenIsNoMerit) {
  // All steps of the candidate in a phase of long steps, in pairs that say so.
  PairedDifference difference;
  for (int i = 0; i < 20; ++i) {
    const double phase = i % 2 == 0 ? 10 : 1;
    difference.add({i % 2 == 0 ? 300.0 : 10.0, (i % 2 == 0 ? 300 : 10) * 99 * phase},
                   {i % 2 == 0 ? 300.0 : 10.0, (i % 2 == 0 ? 300 : 10) * 100 * phase});
  }
  EXPECT_LT(difference.mean(), 0);
  EXPECT_LT(difference.mean(), -2 * difference.error());
}

TEST(Trials, RareScenesAreJudgedWithThoseThatShareTheirCode) {
  std::vector<VolumeId> volumes(100);
  for (VolumeId v = 0; v < 100; ++v) volumes[v] = v;
  for (const double with : {75.0, 130.0}) {
    Trials trials;
    Steps steps;
    for (const VolumeId v : volumes) trials.begin(v, trial(), 0);
    EXPECT_TRUE(steps.make(trials, volumes, 10, 4, with, 100).empty());
    const auto decided = trials.decide(2 * Trials::most_s);
    EXPECT_EQ(decided.size(), 100U);
    for (const auto& [volume, t] : decided) {
      EXPECT_EQ(t->verdict, with > 100 ? Verdict::goes : Verdict::stays) << volume;
    }
    EXPECT_FALSE(trials.open());
  }
}

TEST(Trials, WhatIsNoFasterGoesThoughItMayBeChance) {
  for (const double slower : {131.0, 129.0}) {
    for (const VolumeId seen : {0U, 1U}) {
      Trials trials;
      for (const VolumeId v : {0U, 1U}) trials.begin(v, trial(), 0);
      for (int i = 0; i < 20; ++i) {
        // By less than the pairs differ among themselves; the other volume is never met.
        trials.record(seen, &candidate, i % 2 == 0 ? slower : 70);
        trials.record(seen, &before, 100);
        trials.decide(0.1);
      }
      const auto decided = trials.decide(2 * Trials::most_s);
      ASSERT_EQ(decided.size(), 2U);
      for (const auto& d : decided) {
        EXPECT_EQ(d.trial->verdict, slower > 130 ? Verdict::goes : Verdict::stays) << d.volume;
      }
    }
  }
}

TEST(Trials, WhatNothingIsKnownOfStays) {
  Trials trials;
  trials.begin(1, trial(), 0);
  const auto decided = trials.decide(2 * Trials::most_s);
  ASSERT_EQ(decided.size(), 1U);
  EXPECT_EQ(decided[0].trial->verdict, Verdict::stays);
}

/// Of a scene of wires: bound to the hierarchy of boxes, after its rows of wires had won.
TEST(Trials, AnotherWayGoesUnlessItIsKnownToBeFaster) {
  const auto step = [](int n) {
    return reinterpret_cast<kernels::StepFunction>(static_cast<std::uintptr_t>(n));
  };
  const kernels::DispatchEntry tree{step(1), nullptr, nullptr}, rows{step(2), nullptr, nullptr},
      generic{step(3), nullptr, nullptr};
  Trials trials;
  trials.begin(1, {&tree, &generic}, 0);
  Trial another{&tree, &rows};
  another.to_be_proved = true;
  trials.begin(2, another, 0);
  trials.begin(3, {&tree, &generic}, 0);
  for (int i = 0; i < 20; ++i) {
    trials.record(1, &tree, 70);
    trials.record(1, &generic, 100);
    trials.decide(0.1);
  }
  trials.decide(2 * Trials::most_s);
  EXPECT_EQ(trials.all().at(1).verdict, Verdict::stays);
  EXPECT_EQ(trials.all().at(2).verdict, Verdict::goes) << "faster than generic is not faster";
  EXPECT_EQ(trials.all().at(3).verdict, Verdict::stays) << "as the first, which shares both sides";
}

TEST(Trials, InterruptionsOfTheThreadDecideNothing) {
  Trials trials;
  Steps steps;
  trials.begin(1, trial(), 0);
  for (int i = 0; i < 40 && trials.open(); ++i) {
    trials.record(1, &candidate, i > 2 ? 1e7 : 80);
    steps.make(trials, {1}, 1, 200, 80, 100);
  }
  EXPECT_EQ(trials.all().at(1).verdict, Verdict::stays);
}

TEST(Trials, StepsOfOthersDoNotCount) {
  Trials trials;
  trials.begin(1, trial(), 0);
  for (int i = 0; i < 1000; ++i) {
    trials.record(1, &other, 1e3);
    trials.record(2, &candidate, 1e3);
  }
  EXPECT_EQ(trials.all().at(1).with.count + trials.all().at(1).without.count, 0);
}

TEST(Trials, BeginAgainOnceTheyHaveCostNextToNothing) {
  Trials trials;
  Steps steps;
  trials.begin(1, trial(), 1);
  steps.make(trials, {1}, 40, 100, 100, 130, 1.1);
  ASSERT_FALSE(trials.open());
  EXPECT_TRUE(trials.begin_again(1.2).empty());
  EXPECT_TRUE(trials.begin_again(0.9 * 0.1 / Trials::most_share).empty());
  EXPECT_EQ(trials.begin_again(1.1 * 0.1 / Trials::most_share).size(), 1U);
  EXPECT_TRUE(trials.open());
  steps.make(trials, {1}, 40, 100, 130, 100, 20);
  EXPECT_EQ(trials.all().at(1).verdict, Verdict::goes) << "the run has moved on";
}

TEST(Trials, WhatWinsWithOthersComesBack) {
  Trials trials;
  Steps steps;
  trials.begin(3, trial(), 0);
  trials.take_in(3);
  EXPECT_EQ(trials.all().at(3).verdict, Verdict::open) << "it has not lost";
  const auto decided = steps.make(trials, {3}, 40, 20, 300, 100);
  ASSERT_EQ(decided.size(), 1U);
  ASSERT_EQ(decided[0].trial->verdict, Verdict::goes);
  decided[0].trial->out = true;
  trials.take_in(3);
  EXPECT_EQ(trials.all().at(3).verdict, Verdict::stays);
  EXPECT_FALSE(trials.all().at(3).out);
  EXPECT_FALSE(trials.open());
}

TEST(Trials, WhatIsTakenOutWhileItIsTriedIsNoLongerOpen) {
  Trials trials;
  trials.begin(3, trial(), 0);
  EXPECT_TRUE(trials.take_out(3, &other, nullptr));
  EXPECT_FALSE(trials.open());
}

TEST(Trials, OnesThatEndAreNoLongerOpen) {
  Trials trials;
  trials.begin(1, trial(), 0);
  trials.begin(1, trial(), 0);
  trials.end(1);
  trials.end(2);
  EXPECT_FALSE(trials.open());
}

}  // namespace
}  // namespace navjit
