// What is compiled first.
#include "runtime/schedule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

Candidate candidate(VolumeId volume, double heat, double compile_ms, double gain_ns = 60) {
  return {volume, heat, heat, compile_ms, gain_ns};
}

SpecialiserOptions plain() {
  SpecialiserOptions options;
  options.compile_weight = 1;
  options.min_steps = 0;
  options.module_ms = 1e9;
  return options;
}

TEST(Schedule, IsDueOnceItHasPaid) {
  const SpecialiserOptions options = plain();
  // 1 ms at 50 ns a step are 20,000 steps.
  EXPECT_FALSE(is_due(candidate(0, 19999, 1, 50), options));
  EXPECT_TRUE(is_due(candidate(0, 20000, 1, 50), options));
  EXPECT_TRUE(is_due(candidate(0, 10000, 1, 50), options, 0.5));
  SpecialiserOptions patient = options;
  patient.min_steps = 30000;
  EXPECT_FALSE(is_due(candidate(0, 20000, 1, 50), patient));
}

TEST(Schedule, NothingUntilOneIsDueThenWhatIsSoonGoesAlong) {
  const SpecialiserOptions options = plain();
  EXPECT_TRUE(next_module({}, options).empty());
  std::vector<Candidate> candidates{candidate(1, 9000, 1, 50), candidate(2, 2000, 1, 50),
                                    candidate(3, 15000, 1, 50)};
  EXPECT_TRUE(next_module(candidates, options).empty());
  candidates.push_back(candidate(4, 25000, 1, 50));
  EXPECT_EQ(next_module(candidates, options), (std::vector<VolumeId>{4, 3, 1}));
}

TEST(Schedule, ComparesWhatIsWonOfLateWithWhatItCosts) {
  std::vector<Candidate> candidates{candidate(1, 1e9, 100), candidate(2, 1e9, 10),
                                    candidate(3, 2e9, 100)};
  EXPECT_EQ(next_module(candidates, plain()), (std::vector<VolumeId>{2, 3, 1}));
  candidates[1].recent = 0;  // another phase's
  EXPECT_EQ(next_module(candidates, plain()), (std::vector<VolumeId>{3, 1, 2}));
}

TEST(Schedule, ModulesStaySmall) {
  SpecialiserOptions options = plain();
  options.module_ms = 400;
  std::vector<Candidate> candidates;
  for (VolumeId v = 0; v < 9; ++v) candidates.push_back(candidate(v, 1e12, 100));
  EXPECT_EQ(next_module(candidates, options).size(), 3U);
  options.batch = 2;
  EXPECT_EQ(next_module(candidates, options).size(), 2U);
  options.module_ms = 10;
  EXPECT_EQ(next_module(candidates, options).size(), 1U);
}

TEST(Schedule, KeepsItsPromisesForAnyScenes) {
  std::mt19937_64 random(1);
  for (int n = 0; n < 3000; ++n) {
    SpecialiserOptions options = plain();
    options.batch = 1 + random() % 12;
    options.module_ms = tests::uniform(random, 1, 2000);
    options.compile_weight = tests::uniform(random, 0.01, 1);
    options.min_steps = random() % 10000;
    std::vector<Candidate> candidates;
    const std::size_t count = random() % 40;
    for (std::size_t v = 0; v < count; ++v) {
      candidates.push_back({static_cast<VolumeId>(v), tests::uniform(random, 0, 1e6),
                            tests::uniform(random, 0, 1e6), tests::uniform(random, 1, 500),
                            tests::uniform(random, 5, 100)});
    }
    const std::vector<VolumeId> module = next_module(candidates, options);
    const bool any = std::any_of(candidates.begin(), candidates.end(),
                                 [&](const Candidate& c) { return is_due(c, options); });
    ASSERT_EQ(module.empty(), !any);
    EXPECT_LE(module.size(), options.batch);
    EXPECT_EQ(std::set<VolumeId>(module.begin(), module.end()).size(), module.size());
    double expected = module_base_ms;
    bool due_before = true;
    for (const VolumeId v : module) {
      expected += candidates[v].compile_ms;
      const bool due = is_due(candidates[v], options);
      EXPECT_TRUE(is_due(candidates[v], options, 0.3));
      EXPECT_TRUE(due_before || !due);
      due_before = due;
    }
    if (module.size() > 1) {
      EXPECT_LE(expected, options.module_ms * (1 + 1e-12));
    }
    // Once its scenes are out of the way, others come: nothing starves.
    for (const VolumeId v : module) candidates[v].heat = 0;
    const bool more = std::any_of(candidates.begin(), candidates.end(),
                                  [&](const Candidate& c) { return is_due(c, options); });
    EXPECT_EQ(next_module(candidates, options).empty(), !more);
  }
}

TEST(CostModel, MoreCostsMore) {
  const Geometry geometry(std::make_shared<const World>(tests::mixed_world()));
  const WorldFacts facts = analyse_world(geometry);
  double leaf = 0, most = 0;
  for (VolumeId v = 0; v < geometry.size(); ++v) {
    const ScenePlan plan = plan_scene(geometry, facts, v);
    const double ms = expected_compile_ms(geometry, plan);
    EXPECT_GT(ms, 0);
    if (geometry.scene(v).daughters.empty()) {
      leaf = std::max(leaf, ms);
      EXPECT_LT(expected_gain_ns(plan), 60);
    } else {
      EXPECT_GT(ms, 90);
    }
    most = std::max(most, ms);
  }
  EXPECT_LT(leaf, 90);
  EXPECT_GT(most, 150);  // the world: several solids
}

}  // namespace
}  // namespace navjit
