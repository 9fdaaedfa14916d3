// Daughters by the boxes of all of them, and of groups of them: that none is left out that a ray or
// a point meets, and that few are asked.
#include <gtest/gtest.h>

#include <random>
#include <type_traits>
#include <vector>

#include "analysis/plan.hpp"
#include "codegen/data/bind.hpp"
#include "codegen/data/parts.hpp"
#include "tests/analysis/patterns/arrangement.hpp"

namespace navjit {
namespace {

using tests::Arrangement;
using tests::uniform;

constexpr double half = 60;

/// Boxes, tubes and booleans at random, some over others.
Arrangement mixed(std::uint64_t seed, std::size_t count) {
  std::mt19937_64 random(seed);
  Arrangement a(make_box("mother", half, half, half));
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 at{uniform(random, -50, 50), uniform(random, -50, 50), uniform(random, -50, 50)};
    const Vec3 angles = random() % 3 == 0 ? Vec3{0.3, uniform(random, 0, 3), 0.1} : Vec3{0, 0, 0};
    const double size = uniform(random, 1, 9);
    switch (random() % 3) {
      case 0:
        a.add(make_box("box", size, 2, 3), at, angles);
        break;
      case 1:
        a.add(make_tube("tube", size / 2, size, 4, 0, 7), at, angles);
        break;
      default:
        a.add(make_subtraction("cut", make_box("b", size, size, size),
                               make_tube("t", 0, size / 2, 9, 0, 7)),
              at, angles);
    }
  }
  a.finished(random);
  return a;
}

/// Daughters that count how many of them are asked.
struct Counted {
  static constexpr unsigned listed = 0;
  const Arrangement& a;
  unsigned count;
  mutable std::size_t asked = 0;

  explicit Counted(const Arrangement& from)
      : a(from), count(static_cast<unsigned>(from.daughters().size())) {}
  double distance(unsigned k, const Vec3& p, const Direction& v, double, double) const {
    ++asked;
    return tests::distance(a.daughters()[k], p, v);
  }
  double entry(unsigned k, const Vec3& p, const Direction& v, double reach, double tol) const {
    return distance(k, p, v, reach, tol);
  }
  bool holds(unsigned k, const Vec3& p, const Direction& v, double tol) const {
    ++asked;
    const Daughter& d = a.daughters()[k];
    return contains(d.solid, to_local(d.transformation, p), to_local(d.transformation, v), tol);
  }
};

template <class Search>
struct Made {
  static constexpr Candidates candidates =
      std::is_same_v<Search, kernels::SearchScan> ? Candidates::scan : Candidates::groups;
  codegen::Arena arena;
  Search search{};

  explicit Made(const Arrangement& a) {
    WorldFacts facts = analyse_world(*a.geometry);
    facts.forced_candidates[0] = candidates;
    const ScenePlan plan = plan_scene(*a.geometry, facts, 0);
    EXPECT_EQ(plan.candidates, candidates);
    codegen::make({*a.geometry, plan, a.geometry->scene(0), arena}, search);
  }
};

template <class Search>
class Scan : public testing::Test {
 protected:
  static std::vector<std::size_t> counts() {
    if constexpr (Made<Search>::candidates == Candidates::scan) return {2, 5, 8, 9, 31, 63, 64};
    return {33, 64, 65, 72, 200, 512, 513, 1024};
  }
};
using Searches = testing::Types<kernels::SearchScan, kernels::SearchGroups>;
TYPED_TEST_SUITE(Scan, Searches);

TYPED_TEST(Scan, AnswersAsAllDaughtersDo) {
  for (const std::size_t count : TestFixture::counts()) {
    const Arrangement a = mixed(count, count);
    const Made<TypeParam> scan(a);
    std::mt19937_64 random(17);
    Counted some(a), all(a);
    std::size_t met = 0, held = 0;
    for (int i = 0; i < (count > 100 ? 600 : 3000); ++i) {
      const auto [p, d] = tests::random_ray(random, a, half, i);
      const Direction v = kernels::make_direction(d.x, d.y, d.z);
      const double limit = i % 3 == 0 ? uniform(random, 0, half) : tests::infinite;
      double best = 4 * half, expected = best;
      const int hit = scan.search.nearest(some, p, v, best, limit, 0, tests::pattern_tolerance);
      const int right =
          kernels::SearchAll{}.nearest(all, p, v, expected, limit, 0, tests::pattern_tolerance);
      if (expected <= limit) {
        EXPECT_EQ(hit, right) << "ray " << i << " of " << count;
        EXPECT_EQ(best, expected);
        met += right >= 0 ? 1 : 0;
      }
      const int blocked = i % 2 == 0 ? -1 : static_cast<int>(random() % count);
      const int in = kernels::SearchAll{}.find(all, p, v, blocked, tests::pattern_tolerance);
      EXPECT_EQ(scan.search.find(some, p, v, blocked, tests::pattern_tolerance), in);
      held += in >= 0 ? 1 : 0;
    }
    EXPECT_GT(met, count > 4 ? 40U : 5U);
    EXPECT_GT(held, count > 4 ? 5U : 0U);
    if (count > 8) {
      EXPECT_LT(4 * some.asked, all.asked) << "it is a search";
    }
  }
}

/// What was left for good is not even looked at.
TYPED_TEST(Scan, LeavesOutWhatWasLeftForGood) {
  const Arrangement a = mixed(7, 40);
  const Made<TypeParam> scan(a);
  std::mt19937_64 random(18);
  std::size_t spared = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto [p, d] = tests::random_ray(random, a, half, i);
    const Direction v = kernels::make_direction(d.x, d.y, d.z);
    const Counted daughters(a);
    const auto nearest = [&](unsigned left) {
      const kernels::MostlyAhead<Counted, false> ahead{daughters, daughters.count, left};
      double best = 4 * half;
      daughters.asked = 0;
      const int hit = scan.search.nearest(ahead, p, v, best, best, 0, tests::pattern_tolerance);
      return std::pair(hit, daughters.asked);
    };
    const auto [first, asked] = nearest(kernels::LeftForGood::none);
    if (first < 0) continue;
    const auto [next, asked_then] = nearest(static_cast<unsigned>(first));
    EXPECT_NE(next, first);
    spared += next < 0 && asked_then < asked ? 1 : 0;
  }
  EXPECT_GT(spared, 100U);
}

TEST(ChosenSearch, IsAScanForDozensOfDaughtersInNoPattern) {
  for (const auto& [count, expected] :
       {std::pair<std::size_t, bool>{4, false}, {16, true}, {64, true}, {65, false}}) {
    const Arrangement a = mixed(3, count);
    const ScenePlan plan = plan_scene(*a.geometry, analyse_world(*a.geometry), 0);
    EXPECT_EQ(plan.candidates == Candidates::scan, expected) << count;
    EXPECT_EQ(plan.boxes.size(), count) << "for what else may be bound to data";
  }
}

}  // namespace
}  // namespace navjit
