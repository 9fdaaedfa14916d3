// What JitMode::wait compiles before a run begins, in which portions, and when it stops.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "tests/support/traces.hpp"

namespace navjit {
namespace {

struct Made {
  std::size_t modules = 0, specialised = 0;
};

/// What a run has that waits for its code. All its answers have to be right.
Made wait_for(const SpecialiserOptions& limits) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  RuntimeOptions options = tests::eager_options(JitMode::wait);
  options.specialiser.solids = false;
  options.specialiser.structures = false;
  options.specialiser.module_ms = limits.module_ms;
  options.specialiser.wait_ms = limits.wait_ms;
  Runtime runtime(world, options);
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

TEST(Wait, EndsWhereItIsExpectedToTakeLonger) {
  SpecialiserOptions limits;
  limits.wait_ms = 0;
  const Made bound = wait_for(limits);
  EXPECT_EQ(bound.modules, 0U);
  EXPECT_EQ(bound.specialised, 0U);
}

}  // namespace
}  // namespace navjit
