// Scenes that lost their trials and are tried again: the report names what is installed.
#include <gtest/gtest.h>

#include "analysis/plan.hpp"
#include "codegen/data/bind.hpp"
#include "geometry/navigation/generic.hpp"
#include "runtime/bind_to_data.hpp"
#include "runtime/judge.hpp"
#include "runtime/specialisation.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

/// The number of scenes whose report agrees with the dispatch table.
std::size_t reported_rightly(const Specialisation& spec) {
  std::size_t count = 0;
  for (const auto& [volume, trial] : spec.trials.all()) {
    const bool generic = spec.shared->table.at(volume) == &generic::dispatch_entry;
    count += (spec.scenes.at(volume).binding == Binding::generic) == generic ? 1 : 0;
  }
  return count;
}

TEST(TriedAgain, TheReportSaysWhatIsInstalled) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  const auto shared =
      std::make_shared<detail::Shared>(world, RuntimeOptions{}, Faults{.lose_trials = true});
  Specialisation spec(shared);
  shared->table.keep(spec.arena);
  for (VolumeId v = 0; v < world->volumes.size(); ++v) bind_to_data(spec, v);
  const std::size_t scenes = spec.trials.all().size();
  ASSERT_GE(scenes, 3U);
  EXPECT_TRUE(spec.trials.open());
  spec.second_choices.clear();

  // Long after they began, all of them have lost.
  spec.active = true;
  spec.active_s = 1000;
  judge(spec);
  judge(spec);
  EXPECT_FALSE(spec.trials.open());
  for (const auto& [volume, trial] : spec.trials.all()) {
    EXPECT_TRUE(trial.out);
    EXPECT_EQ(shared->table.at(volume), &generic::dispatch_entry);
    EXPECT_NE(spec.scenes.at(volume).note, "");
  }
  EXPECT_EQ(reported_rightly(spec), scenes);

  // Once trials have cost next to nothing they begin again, with what had lost.
  spec.active_s = 1e9;
  spec.unproved_judged = spec.all_judged = 2 * scenes;  // nor are any tried together
  shared->faults.lose_trials = false;
  judge(spec);
  EXPECT_TRUE(spec.trials.open());
  spec.active = false;
  show_candidates(spec);
  for (const auto& [volume, trial] : spec.trials.all()) {
    EXPECT_FALSE(trial.out);
    EXPECT_EQ(shared->table.at(volume), trial.candidate);
    EXPECT_EQ(spec.scenes.at(volume).binding, Binding::data) << "else nobody watches it";
    EXPECT_EQ(spec.scenes.at(volume).note, "");
  }
  judge_finally(spec);
  EXPECT_EQ(reported_rightly(spec), scenes);
}

/// Code from the cache is installed before anything is bound to data.
TEST(TriedAgain, WhatTheCacheHadAndLostIsBoundToData) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  const auto shared =
      std::make_shared<detail::Shared>(world, RuntimeOptions{}, Faults{.lose_trials = true});
  Specialisation spec(shared);
  shared->table.keep(spec.arena);
  codegen::Arena tables;
  const auto code = std::make_shared<int>();  // stands for its owner
  const VolumeId cached = 1, both = 2;
  bind_to_data(spec, both);
  for (const VolumeId v : {cached, both}) {
    const kernels::DispatchEntry* record = codegen::bind_to_data(
        spec.shared->geometry, plan_scene(spec.shared->geometry, spec.facts, v), tables);
    shared->table.install(v, record, code);
    spec.bound.insert(v);
    try_out(spec, v, record, code);
  }
  spec.second_choices.clear();
  spec.active = true;
  spec.active_s = 1000;
  judge(spec);
  judge(spec);
  EXPECT_EQ(shared->table.at(cached), &generic::dispatch_entry);
  EXPECT_EQ(shared->table.at(both), spec.without_code.at(both));
  EXPECT_FALSE(spec.bound.contains(cached));
  EXPECT_TRUE(spec.bound.contains(both));
  bind_to_data(spec, cached);
  EXPECT_EQ(spec.scenes.at(cached).binding, Binding::data);
  EXPECT_NE(shared->table.at(cached), &generic::dispatch_entry);
}

}  // namespace
}  // namespace navjit
