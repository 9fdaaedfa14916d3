// How often the specialiser looks at the profile: often while it learns, but never at a cost that a
// long run would notice.
#include "runtime/pace.hpp"

#include <gtest/gtest.h>

namespace navjit {
namespace {

constexpr double poll_s = 0.005;

double after(Pace& pace, double look_s, double navigated_s, bool is_quiet) {
  return pause_after(
      pace, {.took_s = look_s, .navigated_s = navigated_s, .is_quiet = is_quiet, .poll_s = poll_s});
}

/// The cost of all looks at a run of this length.
double spent_after(Pace& pace, double run_s, double look_s, int threads, bool is_quiet) {
  const double before = pace.spent_s;
  for (double now = 0; now < run_s;) {
    now += look_s + poll_s * after(pace, look_s, threads * now, is_quiet);
  }
  return pace.spent_s - before;
}

TEST(Pace, LooksAreMadeAtOnceWhileSomethingIsTried) {
  Pace pace;
  for (int look = 0; look < 100; ++look) EXPECT_EQ(after(pace, 1e-4, 0, false), 1);
}

TEST(Pace, LooksAreRarerWhileNothingIs) {
  Pace pace;
  EXPECT_EQ(after(pace, 1e-4, 0, true), 2);
  EXPECT_EQ(after(pace, 1e-4, 0, true), 4);
  EXPECT_EQ(after(pace, 1e-4, 0, true), 4);
  EXPECT_EQ(after(pace, 1e-4, 0, false), 1);
}

TEST(Pace, ALongRunDoesNotFeelThem) {
  // A large detector, whose looks take 0.7 ms: 12% of a processor if nothing held them back.
  for (const int threads : {1, 4}) {
    Pace pace;
    const double run_s = 200;
    const double spent = spent_after(pace, run_s, 0.0007, threads, false);
    EXPECT_LT(spent, Pace::first_s + 1.1 * Pace::share * threads * run_s);
    EXPECT_GT(spent, 0.8 * Pace::share * threads * run_s) << "it may look as often as that";
  }
}

TEST(Pace, TheLongestPauseLeavesEnoughStretchesForATrial) {
  Pace pace;
  spent_after(pace, 10, 0.05, 1, false);
  EXPECT_EQ(after(pace, 0.05, 10, false), Pace::longest_thrifty);
  EXPECT_GT(2 / (poll_s * Pace::longest_thrifty), 2 * 8) << "eight pairs in two seconds";
}

TEST(Pace, WhileNobodyNavigatesAProcessorIsLeftAlone) {
  Pace pace;
  Look look{.took_s = 0.01, .navigated_s = 1, .is_quiet = true, .is_idle = true};
  double before = 0, last = 0;
  for (int i = 0; i < 20; ++i) {
    before = last;
    last = pause_after(pace, look);
    EXPECT_GE(last, before);
  }
  EXPECT_EQ(last, Pace::longest_idle);
  look.is_idle = false;
  EXPECT_LT(pause_after(pace, look), Pace::longest_idle + 1);
  // Whatever is being tried.
  Pace fresh;
  for (int i = 0; i < 10; ++i) last = pause_after(fresh, {.took_s = 1e-4, .is_idle = true});
  EXPECT_EQ(last, Pace::longest_idle);
}

TEST(Pace, LooksOfALargeDetectorTakeTheirShareAndNoMore) {
  // 40,000 volumes: 12% of a processor if the longest pause were the same for all.
  Pace pace;
  const double run_s = 500;
  EXPECT_LT(spent_after(pace, run_s, 0.01, 1, true), Pace::first_s + 1.3 * Pace::share * run_s);
}

TEST(Pace, WhatWasTooMuchAtFirstIsMadeUpFor) {
  Pace pace;
  spent_after(pace, 5, 0.01, 1, false);
  EXPECT_GT(after(pace, 0.01, 5, false), 8);
  // Much later the share has caught up.
  for (int look = 0; look < 5; ++look) after(pace, 1e-4, 1000, false);
  EXPECT_EQ(after(pace, 1e-4, 1000, false), 1);
}

}  // namespace
}  // namespace navjit
