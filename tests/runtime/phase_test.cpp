// A simulation whose hot region changes.
#include <gtest/gtest.h>

#include <set>

#include "tests/support/traces.hpp"

namespace navjit {
namespace {

/// Rays that stay in one half of the world.
std::vector<Ray> rays_in_half(const World& world, std::uint64_t seed, int side) {
  std::vector<Ray> rays = tests::rays_through(world, seed, 300);
  for (Ray& ray : rays) {
    ray.position.x = side * std::abs(ray.position.x);
    if (ray.direction.x * side < 0) ray.direction.x = -ray.direction.x;
  }
  return rays;
}

std::set<std::string> specialised(const Runtime& runtime) {
  std::set<std::string> names;
  for (const SceneReport& scene : runtime.report().scenes) {
    if (scene.status == SceneStatus::specialised) names.insert(scene.volume);
  }
  return names;
}

TEST(Phases, AnotherRegionThatBecomesHotIsNoticed) {
  const auto world = std::make_shared<const World>(tests::random_world(5, 4));
  RuntimeOptions options = tests::eager_options(JitMode::on);
  options.specialiser.min_steps = 100;
  Runtime runtime(world, options);
  Runtime generic(world, tests::eager_options(JitMode::off));
  Navigator navigator = runtime.navigator(), reference = generic.navigator();
  const auto run = [&](int side) {
    for (int pass = 0; pass < 20; ++pass) {
      for (const Ray& ray : rays_in_half(*world, 40 + static_cast<std::uint64_t>(side), side)) {
        EXPECT_TRUE(tests::same_bits(tests::trace(navigator, ray, world->tolerance),
                                     tests::trace(reference, ray, world->tolerance)));
      }
      runtime.wait_until_idle();
    }
  };
  run(-1);
  const std::set<std::string> first = specialised(runtime);
  EXPECT_GT(first.size(), 4U);
  run(1);
  const std::set<std::string> both = specialised(runtime);
  EXPECT_GT(both.size(), first.size() + 4);
}

TEST(Phases, CountsOutliveNavigators) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  for (const JitMode mode : {JitMode::off, JitMode::on}) {
    Runtime runtime(world, tests::eager_options(mode));
    std::uint64_t steps = 0;
    for (int i = 0; i < 400; ++i) {  // more than profiles are kept
      Navigator navigator = runtime.navigator();
      for (const Ray& ray : tests::rays_through(*world, static_cast<std::uint64_t>(i), 3)) {
        steps += tests::trace(navigator, ray, world->tolerance).size();
      }
    }
    EXPECT_EQ(runtime.report().steps, steps);
    EXPECT_EQ(runtime.final_report().steps, steps);
    std::uint64_t profiled = 0;
    for (const StepProfile::Volume& v : runtime.step_profile().volumes) profiled += v.steps;
    EXPECT_EQ(profiled, steps);
  }
}

}  // namespace
}  // namespace navjit
