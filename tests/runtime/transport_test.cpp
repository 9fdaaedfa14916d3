// When a ray counts as stuck.
#include "runtime/transport.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace navjit {
namespace {

constexpr double tolerance = 1e-9;

/// Gives steps of the same few lengths again and again, up to a total number.
struct Steps {
  std::vector<double> lengths;
  int most;
  int made = 0;

  State locate(const Vec3&, const Vec3&) { return State{1, 0}; }
  Step step(const State& state, const Vec3&, const Vec3&) {
    const double length = lengths[static_cast<std::size_t>(made) % lengths.size()];
    return {length, true, ++made < most ? state : State{}};
  }
};

RayTotals totals_of(Steps steps) { return transport(steps, Ray{{0, 0, 0}, {1, 0, 0}}, tolerance); }

TEST(Transport, ARayThatStandsOrCrawlsIsStuck) {
  EXPECT_TRUE(totals_of({{0}, 100000}).stuck);
  EXPECT_TRUE(totals_of({{0, 1.6 * tolerance}, 100000}).stuck) << "far from the origin, on a face";
  EXPECT_TRUE(totals_of({{0, 500 * tolerance}, 100000}).stuck);
}

TEST(Transport, ARayThatGoesOnIsNot) {
  const RayTotals thin = totals_of({{1e-5}, 5000});
  EXPECT_FALSE(thin.stuck) << "layers of ten nanometres";
  EXPECT_EQ(thin.steps, 5000U);
  std::vector<double> now_and_then(90, 0.0);
  now_and_then.push_back(1);
  EXPECT_FALSE(totals_of({now_and_then, 5000}).stuck);
}

}  // namespace
}  // namespace navjit
