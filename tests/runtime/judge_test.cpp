// A run takes out navigators that are slower in it, whatever a replay of recorded states showed.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <mutex>

#include "geometry/navigation/generic.hpp"
#include "runtime/judge.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/support/traces.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

using tests::rays_through;

/// Code that gives the right answers, but waits before each place where its text is `quick`.
std::shared_ptr<const Faults> slow_code(const std::string& quick) {
  const auto faults = std::make_shared<Faults>();
  faults->skip_replay = true;
  faults->edit_source = [quick](std::string& source) {
    const std::string slow = "  for (volatile int i = 0; i < 500; i = i + 1) {}\n" + quick;
    for (std::size_t at = 0; (at = source.find(quick, at)) != std::string::npos;
         at += slow.size()) {
      source.replace(at, quick.size(), slow);
    }
  };
  return faults;
}

constexpr const char* lost_alone = "slower in the run than what was there";
constexpr const char* lost_together =
    "with the other compiled scenes slower in the run than without";

/// A factor in time that is large, whatever sanitizers do to the generic navigator.
constexpr double far = 64;

std::size_t taken_out(const Runtime& runtime, const std::string& note = lost_alone) {
  std::size_t scenes = 0;
  for (const SceneReport& scene : runtime.report().scenes) {
    // Of what is bound to data some may lose as well, while the compiler works.
    const bool compiled = note != lost_alone || scene.status == SceneStatus::unprofitable;
    scenes += scene.note == note && scene.binding != Binding::constants && compiled ? 1 : 0;
  }
  return scenes;
}

/// A run with some slow navigators, until a scene was taken out; with or without safeties.
void expect_taken_out(const std::string& quick, bool safeties) {
  if (tests::under_thread_sanitizer) {
    GTEST_SKIP() << "what is generated is not instrumented: even slow code is faster than the rest";
  }
  const auto world = std::make_shared<const World>(tests::mixed_world());
  const std::vector<Ray> rays = rays_through(*world, 47, 200);
  Runtime generic(world, tests::eager_options(JitMode::off));
  Navigator right = generic.navigator();
  FaultyOptions options{tests::eager_options(JitMode::on)};
  options.specialiser.keep_only_faster = true;
  options.specialiser.optimisation = 1;
  // What is slow is the code of scenes: it is not to wait for other compiling, however busy the
  // machine.
  options.specialiser.structures = false;
  options.specialiser.compile_first_ms = 1e6;
  options.faults = slow_code(quick);
  FaultyRuntime runtime(world, options);
  Navigator navigator = runtime.navigator();
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (taken_out(runtime) == 0 && std::chrono::steady_clock::now() < give_up) {
    for (const Ray& ray : rays) {
      const RayTotals a = transport(right, ray, world->tolerance);
      const RayTotals b = transport(navigator, ray, world->tolerance);
      ASSERT_EQ(a.steps, b.steps);
      ASSERT_EQ(a.length, b.length);
      if (!safeties) continue;
      State at = right.locate(ray.position, ray.direction);
      for (Vec3 p = ray.position; at.inside();) {
        ASSERT_EQ(right.safety(at, p), navigator.safety(at, p));
        const Step step = right.step(at, p, ray.direction, 1e9);
        p = p + step.length * ray.direction;
        at = step.next;
      }
    }
  }
  EXPECT_GE(taken_out(runtime), 1U);
  // And the report of a run that ends then says so, too.
  const RuntimeReport report = runtime.final_report();
  EXPECT_GT(report.modules, 0U);
}

TEST(Judge, ARunTakesOutWhatIsSlowInIt) { expect_taken_out("  return best;\n", false); }

TEST(Judge, WhatEachSceneIsForgivenAllOfThemAreNot) {
  if (tests::under_thread_sanitizer) {
    GTEST_SKIP() << "what is generated is not instrumented: even slow code is faster than the rest";
  }
  const auto world = std::make_shared<const World>(tests::mixed_world());
  const std::vector<Ray> rays = rays_through(*world, 47, 200);
  FaultyOptions options{tests::eager_options(JitMode::on)};
  options.specialiser.keep_only_faster = true;
  options.specialiser.optimisation = 1;
  options.specialiser.structures = false;
  options.specialiser.compile_first_ms = 1e6;
  auto faults = std::make_shared<Faults>(*slow_code("  return best;\n"));
  faults->pass_trials = true;
  options.faults = faults;
  FaultyRuntime runtime(world, options);
  Runtime generic(world, tests::eager_options(JitMode::off));
  Navigator right = generic.navigator(), navigator = runtime.navigator();
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (taken_out(runtime, lost_together) < 3 && std::chrono::steady_clock::now() < give_up) {
    for (const Ray& ray : rays) {
      const RayTotals a = transport(right, ray, world->tolerance);
      const RayTotals b = transport(navigator, ray, world->tolerance);
      ASSERT_EQ(a.steps, b.steps);
      ASSERT_EQ(a.length, b.length);
    }
  }
  EXPECT_EQ(taken_out(runtime), 0U) << "alone they pass";
  EXPECT_GE(taken_out(runtime, lost_together), 3U);
}

/// Nothing is compiled, and everything that is bound to data is tried in the run, which is taken to
/// last `lasts` times as long.
FaultyOptions bound_alone(Faults faults, double lasts) {
  FaultyOptions options{tests::eager_options(JitMode::on)};
  options.specialiser.keep_only_faster = true;
  options.specialiser.constants = options.specialiser.structures = false;
  options.specialiser.solids = false;
  faults.skip_replay = true;
  faults.specialised_lasts = lasts;
  options.faults = std::make_shared<Faults>(std::move(faults));
  return options;
}

/// A candidate that is bound to data is replaced by code while it is on trial itself. So many
/// states of the volume were recorded; on them it took that share of the generic navigator's time.
struct Replaced {
  static constexpr VolumeId volume = 0;
  std::shared_ptr<detail::Shared> shared;
  Specialisation spec;
  kernels::DispatchEntry data = generic::dispatch_entry, code = generic::dispatch_entry;

  Replaced(const Faults& faults, std::size_t recorded, double share)
      : shared(std::make_shared<detail::Shared>(std::make_shared<const World>(tests::mixed_world()),
                                                RuntimeOptions{}, faults)),
        spec(shared) {
    spec.samples[volume].resize(recorded);
    try_out(spec, volume, &data, spec.arena);
    spec.scenes[volume].generic_ns_per_step = 100;
    spec.scenes[volume].specialised_ns_per_step = 100 * share;
    try_out(spec, volume, &code, std::make_shared<int>());
    EXPECT_EQ(trial().before, &data);
    spec.active = true;
    spec.active_s = 1e9;  // time enough
    judge(spec);
    judge(spec);
  }
  const Trial& trial() const { return spec.trials.all().at(volume); }
};

TEST(Judge, WhatWinsOverWhatWasNeverJudgedIsTriedAgainstWhatCameBefore) {
  for (const auto& [recorded, share] :
       {std::pair{few_recorded - 1, 0.5}, std::pair{few_recorded, 0.95}}) {
    const Replaced won({.pass_trials = true}, recorded, share);
    EXPECT_EQ(won.trial().candidate, &won.code);
    EXPECT_EQ(won.trial().before, &generic::dispatch_entry);
    EXPECT_EQ(won.trial().verdict, Verdict::open);
    const Replaced lost({.lose_trials = true}, recorded, share);
    EXPECT_EQ(lost.trial().candidate, &lost.data);
    EXPECT_EQ(lost.trial().before, &generic::dispatch_entry);
    EXPECT_EQ(lost.trial().verdict, Verdict::open);
  }
  const Replaced known({.pass_trials = true}, few_recorded, 0.5);
  EXPECT_EQ(known.trial().before, &known.data) << "it was fast on the states of this run";
  EXPECT_EQ(known.trial().verdict, Verdict::stays);
}

TEST(Judge, AllThatIsNotGenericIsTriedAgainstTheGenericNavigator) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  const std::vector<Ray> rays = rays_through(*world, 47, 200);
  FaultyRuntime runtime(world, bound_alone({.pass_trials = true}, far));
  Navigator navigator = runtime.navigator();
  const std::string lost =
      "with the other scenes that are not generic slower in the run than without";
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (taken_out(runtime, lost) < 3 && std::chrono::steady_clock::now() < give_up) {
    for (const Ray& ray : rays) transport(navigator, ray, world->tolerance);
  }
  EXPECT_GE(taken_out(runtime, lost), 3U);
  for (const SceneReport& scene : runtime.report().scenes) {
    EXPECT_TRUE(scene.note != lost || scene.binding == Binding::generic) << scene.volume;
  }
}

/// What became of scenes that had lost trials of their own.
struct TriedTogether {
  bool won = false;       ///< they were tried together, and the run was faster with them
  std::size_t bound = 0;  ///< scenes that are bound to data in the end

  bool came_back() const { return won && bound >= 3; }
};
/// A run in which everything that is bound to data loses its own trials, and which is taken to last
/// `lasts` times as long. It ends when scenes have come back, or after so many seconds.
TriedTogether tried_together(double lasts, int seconds) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  const std::vector<Ray> rays = rays_through(*world, 47, 200);
  FaultyOptions options = bound_alone({.lose_trials = true}, lasts);
  std::atomic<bool> won = false;
  options.log = [&](LogLevel, std::string_view line) {
    if (line.find("unproved=true verdict=stays") != std::string_view::npos) won = true;
  };
  FaultyRuntime runtime(world, options);
  Navigator navigator = runtime.navigator();
  TriedTogether now;
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  while (!now.came_back() && std::chrono::steady_clock::now() < give_up) {
    for (const Ray& ray : rays) transport(navigator, ray, world->tolerance);
    now = {won, 0};
    for (const SceneReport& scene : runtime.report().scenes) {
      now.bound += scene.binding == Binding::data ? 1 : 0;
    }
  }
  return now;
}

TEST(Judge, WhatLostByChanceIsTriedAgainTogether) {
  EXPECT_TRUE(tried_together(1.0 / far, 60).came_back());
  const TriedTogether slower = tried_together(far, 5);
  EXPECT_FALSE(slower.won) << "that was no chance";
  EXPECT_LT(slower.bound, 3U);
}

/// The number after `key` in a line of the log about a trial.
double number_after(const std::string& line, const std::string& key) {
  const std::size_t at = line.find(key);
  return at == std::string::npos ? 0 : std::strtod(line.c_str() + at + key.size(), nullptr);
}

TEST(Judge, AMotherThatItsDaughtersFillIsJudgedByTheirSteps) {
  // Plates and tiles fill the stack: no step is made in it.
  const auto world = std::make_shared<const World>(tests::mixed_world());
  RuntimeOptions options = tests::eager_options(JitMode::on);
  options.specialiser.keep_only_faster = true;
  options.specialiser.constants = options.specialiser.structures = false;
  options.specialiser.solids = false;
  std::mutex mutex;
  double judged_by = 0;
  options.log = [&](LogLevel, std::string_view line) {
    const std::string text(line);
    if (text.find("event=judged") == std::string::npos) return;
    if (text.find("scene=\"stack\"") == std::string::npos) return;
    const std::lock_guard lock(mutex);
    judged_by = number_after(text, "with_steps=");
  };
  Runtime runtime(world, options);
  Navigator navigator = runtime.navigator();
  const std::vector<Ray> rays = rays_through(*world, 48, 200);
  const auto is_judged = [&] {
    const std::lock_guard lock(mutex);
    return judged_by > 0;
  };
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!is_judged() && std::chrono::steady_clock::now() < give_up) {
    for (const Ray& ray : rays) transport(navigator, ray, world->tolerance);
  }
  EXPECT_TRUE(is_judged());
  for (const SceneReport& scene : runtime.report().scenes) {
    EXPECT_NE(scene.volume, "stack") << scene.steps << " steps";
  }
}

TEST(Judge, ARunTakesOutWhatIsSlowInItsSafeties) {
  expect_taken_out("  return smaller(larger(safety - s.tolerance, 0.0), enough);\n", true);
}

}  // namespace
}  // namespace navjit
