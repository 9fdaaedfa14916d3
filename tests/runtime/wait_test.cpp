// What JitMode::wait compiles before a run begins, in which portions, and when it stops.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "runtime/faulty_runtime.hpp"
#include "tests/support/traces.hpp"

namespace navjit {
namespace {

struct Made {
  std::size_t modules = 0, specialised = 0;
};

/// What a run has that waits for its code. All its answers have to be right.
Made wait_for(const SpecialiserOptions& limits, std::shared_ptr<const Faults> faults = {}) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  FaultyOptions options{tests::eager_options(JitMode::wait)};
  options.faults = std::move(faults);
  options.specialiser.solids = false;
  options.specialiser.structures = false;
  options.specialiser.module_ms = limits.module_ms;
  options.specialiser.wait_ms = limits.wait_ms;
  options.specialiser.poll_ms = limits.poll_ms;
  FaultyRuntime runtime(world, options);
  const std::size_t modules = runtime.report().modules;
  EXPECT_EQ(tests::traces_that_differ(runtime, tests::rays_through(*world, 4, 500)), 0U);
  const RuntimeReport report = runtime.report();
  EXPECT_EQ(report.modules, modules) << "compiled while the run went on";
  const auto is_specialised = [](const SceneReport& scene) {
    return scene.status == SceneStatus::specialised;
  };
  return {modules, static_cast<std::size_t>(
                       std::count_if(report.scenes.begin(), report.scenes.end(), is_specialised))};
}

TEST(Wait, NoModuleIsExpectedToTakeLong) {
  SpecialiserOptions limits;
  limits.module_ms = 1e9;
  const Made whole = wait_for(limits);
  EXPECT_EQ(whole.modules, 1U);
  EXPECT_GE(whole.specialised, 3U);
  // Not even one scene is expected to take as little: then each has a module of its own.
  limits.module_ms = 1;
  const Made apart = wait_for(limits);
  EXPECT_GE(apart.modules, 3U);
  EXPECT_EQ(apart.specialised, whole.specialised);
}

TEST(Wait, ACompilationIsNotWaitedForUntilTheNextLookAtTheProfile) {
  SpecialiserOptions limits;
  limits.poll_ms = 3.6e6;
  EXPECT_GE(wait_for(limits).modules, 1U);
}

/// Text that takes the compiler a good part of a second, of which the cost model knows nothing.
std::string text_that_takes_long() {
  std::string text =
      "\nconstexpr long spun(long n) {\n  for (long i = 0; i < 200000; ++i) n += i & 3;\n"
      "  return n;\n}\n";
  for (int i = 0; i < 8; ++i) text += "static_assert(spun(" + std::to_string(i) + ") > 0);\n";
  return text;
}

TEST(Wait, EndsWhereItTakesLonger) {
  SpecialiserOptions limits;
  limits.module_ms = 1;  // one module for each scene
  limits.wait_ms = 300;
  const auto slow = std::make_shared<const Faults>(
      Faults{.edit_source = [](std::string& source) { source += text_that_takes_long(); }});
  EXPECT_LE(wait_for(limits, slow).modules, 1U) << "none, where the compiler gives up before";
}

TEST(Wait, EndsWhereItIsExpectedToTakeLonger) {
  SpecialiserOptions limits;
  limits.wait_ms = 0;
  const Made bound = wait_for(limits);
  EXPECT_EQ(bound.modules, 0U);
  EXPECT_EQ(bound.specialised, 0U);
}

}  // namespace
}  // namespace navjit
