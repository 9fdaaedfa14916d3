// A run takes out what is slower in it, whatever a replay of recorded states said.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <mutex>

#include "tests/support/sanitizers.hpp"
#include "tests/support/traces.hpp"

namespace navjit {
namespace {

using tests::rays_through;

/// Code that gives the right answers, after a while: what ends with `quick` does.
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

std::size_t taken_out(const Runtime& runtime, const std::string& note = lost_alone) {
  std::size_t scenes = 0;
  for (const SceneReport& scene : runtime.report().scenes) {
    // Of what is bound to data some may lose as well, while the compiler works.
    const bool compiled = note != lost_alone || scene.status == SceneStatus::unprofitable;
    scenes += scene.note == note && scene.binding != Binding::constants && compiled ? 1 : 0;
  }
  return scenes;
}

/// A run of which some is slow, until a scene was taken out. With safeties asked, or not.
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

TEST(Judge, AllThatIsNotGenericIsTriedAgainstTheGenericNavigator) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  const std::vector<Ray> rays = rays_through(*world, 47, 200);
  FaultyOptions options{tests::eager_options(JitMode::on)};
  options.specialiser.keep_only_faster = true;
  options.specialiser.constants = options.specialiser.structures = false;
  options.specialiser.solids = false;
  auto faults = std::make_shared<Faults>();
  faults->skip_replay = faults->pass_trials = true;
  faults->specialised_lasts = 3;
  options.faults = faults;
  FaultyRuntime runtime(world, options);
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

/// What the log says of a trial: the number after `key`.
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
