// Rays that crawl come to an end, also where no boundary of their steps counts.
#include <gtest/gtest.h>

#include "navjit/runtime.hpp"
#include "observe/passages.hpp"
#include "runtime/transport_basket.hpp"
#include "tests/observe/worlds.hpp"
#include "tests/support/crawl.hpp"

namespace navjit {
namespace {

using tests::Crawl;

/// In tolerances. The last is so long that a hundred steps together get far ahead.
const std::vector<double> ways{0, 1.6, 500};

TEST(Stuck, ARayWhosePassagesAreCountedIsGivenUp) {
  for (const double way : ways) {
    const Crawl crawl(way);
    const Passages passed = pass_through(crawl.detector.model(), std::vector<Ray>{crawl.ray});
    EXPECT_LT(*crawl.asked, 1000) << way;
    EXPECT_EQ(passed.rays, 1U);
  }
}

TEST(Stuck, AStepThatWalksOnEndsWhereItLastGotAhead) {
  for (const double way : ways) {
    const Crawl crawl(way);
    const ObservedDetector seen(crawl.detector, tests::materials_only);
    Runtime runtime(seen.detector(), {.jit = JitMode::off});
    Navigator navigator = runtime.navigator();
    ObservedNavigator observed(seen, navigator);
    *crawl.asked = 0;
    const State block = observed.locate(crawl.ray.position, crawl.ray.direction);
    const Step step = observed.step(block, crawl.ray.position, crawl.ray.direction);
    EXPECT_LT(*crawl.asked, 1000) << way;
    EXPECT_DOUBLE_EQ(step.length, 10);
    EXPECT_TRUE(step.boundary);
    EXPECT_FALSE(seen.counts(block.volume(), step.next.volume()));
  }
}

TEST(Stuck, ARayOfStepsThatWalkOnIsGivenUpAloneAndInABasket) {
  for (const double way : ways) {
    const Crawl crawl(way);
    const ObservedDetector seen(crawl.detector, tests::materials_only);
    Runtime runtime(seen.detector(), {.jit = JitMode::off});
    const double tolerance = seen.detector().tolerance();
    Navigator navigator = runtime.navigator();
    ObservedNavigator observed(seen, navigator);
    *crawl.asked = 0;
    std::vector<std::pair<State, double>> alone, together;
    const RayTotals totals =
        transport(observed, crawl.ray, tolerance,
                  [&](const State& at, double length) { alone.emplace_back(at, length); });
    EXPECT_TRUE(totals.stuck) << way;
    EXPECT_LT(*crawl.asked, 50000) << way;

    Basket basket = runtime.basket(2);
    const Ray free{{-50, 50, 0}, {1, 0, 0}};
    *crawl.asked = 0;
    const std::vector<RayTotals> both = transport_in_basket(
        basket, std::vector<Ray>{crawl.ray, free}, tolerance,
        [&](std::size_t ray, const State& at, double length) {
          if (ray == 0) together.emplace_back(at, length);
        },
        [] { return true; },
        [&](const State& from, const State& to) {
          return seen.counts(from.volume(), to.volume());
        });
    ASSERT_EQ(both.size(), 2U);
    EXPECT_TRUE(both[0].stuck) << way;
    EXPECT_LT(*crawl.asked, 50000) << way;
    EXPECT_FALSE(both[1].stuck);
    EXPECT_EQ(both[1].length, 150);
    EXPECT_EQ(alone, together) << way;
  }
}

}  // namespace
}  // namespace navjit
