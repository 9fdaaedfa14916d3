// What is compiled first.
#include "runtime/schedule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

Candidate candidate(VolumeId volume, double executions, double compile_ms, double gain_ns = 60) {
  return {volume, executions, executions, compile_ms, gain_ns};
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

TEST(Schedule, WhatFillsAModuleComesFirstWhereItWinsMoreForWhatItCosts) {
  SpecialiserOptions options = plain();
  options.module_ms = 300;
  const Candidate a = candidate(2, 1e12, 100), b = candidate(3, 1e12, 120);
  // These two are 2e12 in 30 + 100 + 120 ms, as much for each ms as 6.64e12 in 30 + 800.
  EXPECT_EQ(next_module(std::vector{candidate(1, 6e12, 800), a, b}, options),
            (std::vector<VolumeId>{2, 3}));
  EXPECT_EQ(next_module(std::vector{candidate(1, 7e12, 800), a, b}, options),
            (std::vector<VolumeId>{1}));
  // And where nothing else is due.
  EXPECT_EQ(next_module(std::vector{candidate(1, 1e12, 800)}, options), (std::vector<VolumeId>{1}));
  // What is not due yet and goes along makes the others come no later.
  EXPECT_EQ(next_module(std::vector{candidate(1, 6e12, 800), a, b, candidate(4, 3e5, 49)}, options),
            (std::vector<VolumeId>{2, 3, 4}));
}

TEST(Schedule, WhatHasPaidLessThanSomethingElseWaitsOnceTheModuleIsWorthIt) {
  SpecialiserOptions options = plain();
  options.module_ms = 2000;
  const std::vector<Candidate> candidates{candidate(1, 4e12, 200), candidate(2, 1e12, 200),
                                          candidate(3, 2e12, 200)};
  EXPECT_EQ(next_module(candidates, options), (std::vector<VolumeId>{1, 3, 2}));
  EXPECT_EQ(next_module(candidates, options, 1.5 * times_paid(candidates[1], options)),
            (std::vector<VolumeId>{1, 3}));
  // A module that is small otherwise takes it along.
  const std::vector<Candidate> small{candidate(1, 4e12, 20), candidate(2, 1e12, 20)};
  EXPECT_EQ(next_module(small, options, 1e300), (std::vector<VolumeId>{1, 2}));
}

TEST(Schedule, ModulesGrowWithTheRun) {
  SpecialiserOptions options = plain();
  options.module_ms = 900;
  const double first = most_module_ms(0, options);
  EXPECT_GT(first, module_base_ms);
  EXPECT_LT(first, 300);
  double before = first;
  for (double seconds = 0.1; seconds < 10; seconds += 0.1) {
    const double now = most_module_ms(seconds, options);
    EXPECT_GE(now, before);
    EXPECT_LE(now, std::max(first, 1e3 * seconds));
    before = now;
  }
  EXPECT_EQ(before, 900);
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
    for (const VolumeId v : module) candidates[v].executions = 0;
    const bool more = std::any_of(candidates.begin(), candidates.end(),
                                  [&](const Candidate& c) { return is_due(c, options); });
    EXPECT_EQ(next_module(candidates, options).empty(), !more);
  }
}

/// A volume like the world volume, a box of 100 mm, with the daughters in a row.
struct Expected {
  double compile_ms, gain_ns;
};
Expected expected_of(const std::vector<Solid>& daughters) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 100, 100, 100));
  for (const Solid& solid : daughters) {
    tests::place(
        world, world.top, tests::add_volume(world, "v", solid),
        {-90 + 10.0 * static_cast<double>(world.volumes[world.top].daughters.size()), 0, 0});
  }
  finish(world);
  const Geometry geometry(std::make_shared<const World>(std::move(world)));
  const WorldFacts facts = analyse_world(geometry);
  const ScenePlan plan = plan_scene(geometry, facts, geometry.world().top);
  return {expected_compile_ms(geometry, plan), expected_gain_ns(plan)};
}

TEST(CostModel, MoreCostsMore) {
  const Solid box = make_box("box", 1, 2, 3), tube = make_tube("tube", 1, 2, 3, 0, 7),
              orb = make_orb("orb", 2);
  const auto polycone = [](int planes) {
    std::vector<ZPlane> of;
    for (int i = 0; i < planes; ++i) of.push_back({double(i) / planes, 0, 2 + i % 2 + 0.0});
    return make_polycone("polycone", of, 0, 7);
  };
  // Each has one thing more than the one before.
  const std::vector<std::vector<Solid>> ever_more = {{},
                                                     {orb},
                                                     {orb, tube},
                                                     {orb, tube, box},
                                                     {orb, tube, box, polycone(4)},
                                                     {orb, tube, box, polycone(9)}};
  Expected last{0, 0};
  for (const auto& daughters : ever_more) {
    const Expected next = expected_of(daughters);
    EXPECT_GT(next.compile_ms, last.compile_ms) << daughters.size();
    EXPECT_GE(next.gain_ns, last.gain_ns) << daughters.size();
    last = next;
  }
  EXPECT_GT(expected_of({box}).gain_ns, expected_of({}).gain_ns);
  // Code is written once for all daughters of one shape, and a large table is a loop.
  EXPECT_LT(expected_of(std::vector<Solid>(12, tube)).compile_ms,
            2 * expected_of({tube}).compile_ms);
  EXPECT_LT(expected_of({polycone(500)}).compile_ms, 2 * expected_of({polycone(50)}).compile_ms);
}

TEST(Schedule, CompilingCountsLessWhereAProcessorIsLeft) {
  EXPECT_DOUBLE_EQ(weight_of_compiling(0.3, 1, 2), 0.01);
  EXPECT_DOUBLE_EQ(weight_of_compiling(0.3, 1.1, 2), 0.01);
  EXPECT_DOUBLE_EQ(weight_of_compiling(0.3, 2, 2), 0.3);
  EXPECT_DOUBLE_EQ(weight_of_compiling(0.3, 1, 1), 0.3);
  EXPECT_DOUBLE_EQ(weight_of_compiling(0.3, 63, 64), 0.01);
  EXPECT_DOUBLE_EQ(weight_of_compiling(0.3, 64, 64), 0.3);
  EXPECT_DOUBLE_EQ(weight_of_compiling(0.3, 0, 0), 0.3) << "how many there are is not known";
}

}  // namespace
}  // namespace navjit
