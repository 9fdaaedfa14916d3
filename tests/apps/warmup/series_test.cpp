// What is concluded from the series of the warm-up experiment.
#include "apps/warmup/series.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace navjit::warmup {
namespace {

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A series with steps at random times, at random rates.
Series random_series(std::mt19937_64& random, int points) {
  Series series{{0, 0}};
  for (int i = 1; i < points; ++i) {
    const Point& last = series.back();
    const double dt = uniform(random, 0.01, 0.3);
    series.push_back({last.seconds + dt, last.steps + dt * uniform(random, 0, 100)});
  }
  return series;
}

TEST(StepsAt, IsLinearBetweenPointsAndConstantBeyond) {
  const Series series{{1, 0}, {2, 10}, {4, 10}, {5, 40}};
  EXPECT_EQ(steps_at(series, 0.5), 0);
  EXPECT_EQ(steps_at(series, 1), 0);
  EXPECT_DOUBLE_EQ(steps_at(series, 1.25), 2.5);
  EXPECT_EQ(steps_at(series, 3), 10);
  EXPECT_DOUBLE_EQ(steps_at(series, 4.5), 25);
  EXPECT_EQ(steps_at(series, 9), 40);
  EXPECT_EQ(steps_at({}, 1), 0);
}

TEST(Rate, SumsToTheSteps) {
  std::mt19937_64 random(1);
  for (int n = 0; n < 50; ++n) {
    const Series series = random_series(random, 20);
    const double end = series.back().seconds;
    double steps = 0;
    for (int i = 0; i < 7; ++i) steps += rate(series, end * i / 7, end * (i + 1) / 7) * end / 7;
    EXPECT_NEAR(steps, series.back().steps, 1e-9 * (1 + series.back().steps));
  }
  EXPECT_EQ(rate({{0, 0}, {1, 5}}, 1, 1), 0);
}

TEST(BreakEven, IsThatOfTwoStraightLines) {
  // Late by d, then k times as fast: even at d k / (k - 1).
  for (const double d : {0.1, 0.5, 1.0}) {
    for (const double k : {1.5, 2.0, 4.0}) {
      const Series base{{0, 0}, {5, 500}};
      const Series run{{0, 0}, {d, 0}, {5, k * (5 - d) * 100}};
      const auto even = break_even(run, base);
      ASSERT_TRUE(even);
      EXPECT_NEAR(*even, d * k / (k - 1), 1e-12);
    }
  }
}

TEST(BreakEven, KnowsNeverAndAtOnce) {
  const Series slow{{0, 0}, {1, 10}, {5, 50}}, fast{{0, 0}, {2, 40}, {5, 100}};
  EXPECT_EQ(break_even(fast, slow), 0.0);
  EXPECT_EQ(break_even(slow, slow), 0.0);
  EXPECT_EQ(break_even(slow, fast), std::nullopt);
  EXPECT_EQ(break_even({}, slow), std::nullopt);
  EXPECT_EQ(break_even(slow, {}), std::nullopt);
}

TEST(BreakEven, HoldsFromThenOnAndNotBefore) {
  std::mt19937_64 random(2);
  int found = 0;
  for (int n = 0; n < 2000; ++n) {
    const Series run = random_series(random, 12), base = random_series(random, 12);
    const double end = std::min(run.back().seconds, base.back().seconds);
    const auto ahead = [&](double t) { return steps_at(run, t) - steps_at(base, t); };
    const auto even = break_even(run, base);
    if (!even) {
      EXPECT_LT(ahead(end), 0);
      continue;
    }
    ASSERT_LE(*even, end);
    for (int i = 0; i <= 200; ++i) {
      const double t = *even + (end - *even) * i / 200;
      EXPECT_GE(ahead(t), -1e-9) << t;
    }
    if (*even > 0) {
      ++found;
      EXPECT_LT(ahead(*even * (1 - 1e-6)), 1e-9);
      EXPECT_NEAR(ahead(*even), 0, 1e-9);
    }
  }
  EXPECT_GT(found, 200);
}

TEST(BreakEven, DoesNotDependOnUnitsNorOnMorePoints) {
  std::mt19937_64 random(3);
  for (int n = 0; n < 300; ++n) {
    const Series run = random_series(random, 12), base = random_series(random, 12);
    const auto even = break_even(run, base);
    Series more, scaled_run = run, scaled_base = base;
    for (std::size_t i = 0; i < run.size(); ++i) {
      more.push_back(run[i]);
      if (i + 1 == run.size()) break;
      const double t = (run[i].seconds + run[i + 1].seconds) / 2;
      more.push_back({t, steps_at(run, t)});
    }
    for (Series* series : {&scaled_run, &scaled_base}) {
      for (Point& p : *series) p.steps *= 1024;
    }
    const auto refined = break_even(more, base), scaled = break_even(scaled_run, scaled_base);
    ASSERT_EQ(even.has_value(), refined.has_value());
    ASSERT_EQ(even.has_value(), scaled.has_value());
    if (!even) continue;
    EXPECT_NEAR(*refined, *even, 1e-9);
    EXPECT_NEAR(*scaled, *even, 1e-12);
  }
}

TEST(Share, GrowsInSteps) {
  const std::vector<Swap> swaps{{0.5, 0.2}, {0.1, 0.4}, {0.9, 0.3}};
  EXPECT_EQ(share_at(swaps, 0), 0);
  EXPECT_DOUBLE_EQ(share_at(swaps, 0.5), 0.6);
  EXPECT_DOUBLE_EQ(share_at(swaps, 2), 0.9);
  EXPECT_EQ(time_of_share(swaps, 0.5), 0.5);
  EXPECT_EQ(time_of_share(swaps, 0.3), 0.1);
  EXPECT_EQ(time_of_share(swaps, 0.95), std::nullopt);
  EXPECT_EQ(time_of_share({}, 0.5), std::nullopt);
}

TEST(Share, IsReachedWhenItSays) {
  std::mt19937_64 random(4);
  for (int n = 0; n < 500; ++n) {
    std::vector<Swap> swaps;
    for (int i = 0; i < 8; ++i) swaps.push_back({uniform(random, 0, 3), uniform(random, 0, 0.125)});
    const double share = uniform(random, 0, 1);
    const auto at = time_of_share(swaps, share);
    if (!at) {
      EXPECT_LT(share_at(swaps, 3), share);
      continue;
    }
    EXPECT_GE(share_at(swaps, *at), share - 1e-12);
    EXPECT_LT(share_at(swaps, *at - 1e-9), share);
  }
}

TEST(Spread, IsMedianAndExtremes) {
  const Spread odd = spread({3, 1, 2}), even = spread({4, 1, 3, 2});
  EXPECT_EQ(odd.median, 2);
  EXPECT_EQ(odd.low, 1);
  EXPECT_EQ(odd.high, 3);
  EXPECT_EQ(even.median, 2.5);
  EXPECT_EQ(spread({}).median, 0);
}

}  // namespace
}  // namespace navjit::warmup
