// A budget is kept wherever that is promised: judged by the detector with 113 bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "geometry/gdml/read_world.hpp"
#include "geometry/reference/wide_geometry.hpp"
#include "navjit/runtime.hpp"
#include "tests/support/traces.hpp"

namespace navjit {
namespace {

/// Sends rays from anywhere; returns the largest error of the steps made in each volume.
std::vector<double> transport_and_judge(Runtime& runtime, int rays) {
  const World& world = runtime.world();
  const reference::WideGeometry reference(runtime.share_world());
  std::mt19937_64 random(7);
  std::vector<double> worst(world.volumes.size(), 0);
  Navigator navigator = runtime.navigator();
  const Extent& e = world.volumes[world.top].solid.extent;
  for (int i = 0; i < rays; ++i) {
    Vec3 p{uniform(random, e.min.x, e.max.x), uniform(random, e.min.y, e.max.y),
           uniform(random, e.min.z, e.max.z)};
    const Vec3 v = tests::random_direction(random);
    int made = 0;
    for (State state = navigator.locate(p, v); state.inside() && made < 2000; ++made) {
      const Step step = navigator.step(state, p, v);
      const reference::Chain chain = reference::chain_of(world, state.touchable());
      const reference::Quad right =
          reference.step(chain, reference::widen(p), reference::widen_direction(v)).length;
      worst[state.volume()] =
          std::max(worst[state.volume()], reference.across(chain, p, v, step.length, right));
      p += step.length * v;
      state = step.next;
    }
  }
  return worst;
}

/// Budgets from 1e-12 to 1 mm, so many decades apart; returns how many promises were made.
int expect_budgets_kept(const std::shared_ptr<const World>& world, JitMode jit, int rays,
                        int decades = 1) {
  int promises = 0;
  std::vector<double> worst;
  for (int exponent = -12; exponent <= 0; exponent += decades) {
    RuntimeOptions options;
    options.jit = jit;
    options.budget = std::pow(10.0, exponent);
    Runtime runtime(world, options);
    const std::vector<double> errors =
        transport_and_judge(runtime, worst.empty() ? rays : rays / 10);
    if (worst.empty()) worst = errors;
    for (const SceneReport& scene : runtime.final_report().scenes) {
      EXPECT_TRUE(scene.budget.has_value()) << scene.volume;
      if (!scene.budget) continue;
      EXPECT_FALSE(scene.budget->why.empty());
      if (!scene.budget->met) continue;
      ++promises;
      EXPECT_LE(worst[scene.volume_id], *options.budget) << scene.volume;
      EXPECT_LE(errors[scene.volume_id], *options.budget) << scene.volume;
      EXPECT_LE(scene.budget->bound_mm, *options.budget) << scene.volume;
      EXPECT_LE(scene.budget->measured_mm, scene.budget->bound_mm) << scene.volume;
    }
  }
  return promises;
}

TEST(Budget, IsKeptInShippedDetectors) {
  for (const auto& entry : std::filesystem::directory_iterator(NAVJIT_DETECTORS_DIR)) {
    if (entry.path().extension() != ".gdml") continue;
    SCOPED_TRACE(entry.path());
    const auto world = std::make_shared<const World>(read_world(entry.path()));
    EXPECT_GT(expect_budgets_kept(world, JitMode::off, 3000), 20);
  }
}

TEST(Budget, IsKeptBySpecialisedNavigators) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  EXPECT_GT(expect_budgets_kept(world, JitMode::wait, 1000, 3), 10);
}

/// Those of the data folder: a few, or all if NAVJIT_BUDGET_RAYS says how many rays each shall
/// have.
TEST(Budget, IsKeptInPublishedDetectors) {
  if (const char* rays = std::getenv("NAVJIT_BUDGET_RAYS")) {
    int promises = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(NAVJIT_DATA_DIR)) {
      if (entry.path().extension() != ".gdml") continue;
      SCOPED_TRACE(entry.path());
      std::shared_ptr<const World> world;
      try {
        world = std::make_shared<const World>(read_world(entry.path()));
      } catch (const GdmlError& refused) {
        std::printf("refused: %s\n", refused.what());
        continue;
      }
      const int made = expect_budgets_kept(world, JitMode::off, std::atoi(rays));
      std::printf("%s: %d promises kept\n", entry.path().filename().c_str(), made);
      std::fflush(stdout);
      promises += made;
    }
    EXPECT_GT(promises, 1000);
    return;
  }
  int found = 0;
  for (const char* name :
       {"testem3/testEm3.gdml", "celeritas/simple-cms.gdml", "scenes/cutube.gdml",
        "scenes/mbwheel.gdml", "lhcb/lhcbvelo_2006.gdml"}) {
    const std::filesystem::path file = std::filesystem::path(NAVJIT_DATA_DIR) / name;
    if (!std::filesystem::exists(file)) continue;
    ++found;
    SCOPED_TRACE(file);
    const auto world = std::make_shared<const World>(read_world(file));
    EXPECT_GT(expect_budgets_kept(world, JitMode::off, 1500), 4);
  }
  if (found == 0) GTEST_SKIP() << "no published detectors in " << NAVJIT_DATA_DIR;
}

TEST(Budget, BelowAnyBoundIsPromisedNowhereAndRunsAllTheSame) {
  RuntimeOptions options;
  options.jit = JitMode::off;
  options.budget = 1e-300;
  Runtime runtime(tests::mixed_world(), options);
  transport_and_judge(runtime, 20);
  const RuntimeReport report = runtime.final_report();
  ASSERT_FALSE(report.scenes.empty());
  for (const SceneReport& scene : report.scenes) {
    ASSERT_TRUE(scene.budget.has_value());
    EXPECT_FALSE(scene.budget->met);
    EXPECT_NE(scene.budget->why.find("above the budget"), std::string::npos);
  }
}

TEST(Budget, IsPromisedOnlyWhereItWasMeasured) {
  RuntimeOptions options;
  options.jit = JitMode::off;
  options.budget = 1;
  Runtime runtime(tests::mixed_world(), options);
  transport_and_judge(runtime, 3);  // too few to be recorded everywhere
  std::size_t promised = 0;
  for (const SceneReport& scene : runtime.final_report().scenes) {
    ASSERT_TRUE(scene.budget.has_value());
    EXPECT_EQ(scene.budget->met, scene.budget->met && scene.budget->states > 0) << scene.volume;
    promised += scene.budget->met ? 1 : 0;
  }
  EXPECT_GT(promised, 0U) << "states are made up where none was recorded";
}

}  // namespace
}  // namespace navjit
