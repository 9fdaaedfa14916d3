// Scans of the boxes of all daughters, and of groups of them: none that a ray or a point meets is
// left out, and few are asked.
#include <gtest/gtest.h>

#include <algorithm>
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

/// Random boxes, tubes and booleans, some of which overlap.
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
    return {33, 64, 65, 72, 200, 512, 513, 1024, 1025, 3000};
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
      kernels::BoxesAhead boxes{};
      const kernels::MostlyAhead<Counted, false> ahead{daughters, daughters.count, left, &boxes, 0};
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

/// Steps of a ray in one mother, as a run makes them.
TEST(BoxesAhead, AnswerAsAllDaughtersDo) {
  for (const std::size_t count : {33, 200, 1025, 3000}) {
    const Arrangement a = mixed(count + 1, count);
    const Made<kernels::SearchGroups> made(a);
    std::mt19937_64 random(19);
    const Counted some(a), all(a);
    kernels::BoxesAhead boxes{};
    std::size_t steps = 0, remembered = 0, met = 0;
    for (int i = 0; i < 300; ++i) {
      auto [p, d] = tests::random_ray(random, a, half, i);
      const Direction v = kernels::make_direction(d.x, d.y, d.z);
      boxes.search = nullptr;  // as set_ray() does
      for (int n = 0; n < 12; ++n) {
        const unsigned long long mother = i % 5 == 0 ? static_cast<unsigned>(n) : 7;
        // Until the ray leaves the mother, or a step is limited.
        const double out = distance_to_out(a.geometry->scene(0).solid, p, v, 0.0);
        if (!(out > 0)) break;
        const double limit = i % 3 == 0 ? uniform(random, 0, half) : tests::infinite;
        const kernels::MostlyAhead<Counted, false> ahead{
            some, some.count, kernels::LeftForGood::none, &boxes, mother};
        double best = out, expected = out;
        const Vec3 before{boxes.at[0], boxes.at[1], boxes.at[2]};
        const bool known = boxes.search != nullptr && boxes.mother == mother;
        const int hit = made.search.nearest(ahead, p, v, best, limit, 0, tests::pattern_tolerance);
        const int right =
            kernels::SearchAll{}.nearest(all, p, v, expected, limit, 0, tests::pattern_tolerance);
        ++steps;
        remembered += known && n > 0 && before.x == boxes.at[0] && before.y == boxes.at[1] ? 1 : 0;
        if (expected <= limit) {
          EXPECT_EQ(hit, right) << "ray " << i << ", step " << n << " of " << count;
          EXPECT_EQ(best, expected);
          met += right >= 0 ? 1 : 0;
        }
        const double way = std::min({limit, best, out}) + uniform(random, 0, 3);
        p = {p.x + way * d.x, p.y + way * d.y, p.z + way * d.z};
      }
    }
    EXPECT_GT(met, 30U);
    EXPECT_GT(10 * remembered, steps) << count;
  }
}

TEST(BoxesAhead, AreOfOneRayAlone) {
  const Arrangement a = mixed(5, 60);
  const Made<kernels::SearchGroups> made(a);
  const Counted some(a);
  const Direction v = kernels::make_direction(0.36, 0.48, 0.8);
  const auto nearest = [&](kernels::BoxesAhead& boxes, const Vec3& p, double best) {
    const kernels::MostlyAhead<Counted, false> ahead{some, some.count, kernels::LeftForGood::none,
                                                     &boxes, 7};
    made.search.nearest(ahead, p, v, best, tests::infinite, 0, tests::pattern_tolerance);
  };
  const auto is_found_anew = [&](const Vec3& p, double best) {
    kernels::BoxesAhead boxes{};
    nearest(boxes, {-20, -20, -20}, 50);
    nearest(boxes, p, best);
    return boxes.at[0] == p.x;
  };
  EXPECT_FALSE(is_found_anew({-20 + 0.36 * 9, -20 + 0.48 * 9, -20 + 0.8 * 9}, 41));
  EXPECT_TRUE(is_found_anew({-20 + 0.36 * 9 + 1e-6, -20 + 0.48 * 9, -20 + 0.8 * 9}, 41))
      << "beside";
  EXPECT_TRUE(is_found_anew({-20 - 0.36 * 9, -20 - 0.48 * 9, -20 - 0.8 * 9}, 9)) << "before";
  EXPECT_TRUE(is_found_anew({-20 + 0.36 * 9, -20 + 0.48 * 9, -20 + 0.8 * 9}, 42)) << "further";
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
