// A simulation whose hot region changes.
#include <gtest/gtest.h>

#include <set>

#include "tests/support/traces.hpp"

namespace navjit {
namespace {

/// Six large boxes in each half of the world, all of them different.
World two_regions() {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 100, 100, 100));
  for (const int side : {-1, 1}) {
    for (int i = 0; i < 6; ++i) {
      const std::string name = (side < 0 ? "left" : "right") + std::to_string(i);
      const VolumeId box =
          tests::add_volume(world, name, make_box(name, 40 + side - i, 14, 90 - 2 * i));
      const VolumeId core = tests::add_volume(
          world, name + "core", make_tube(name + "core", 0, 9 + 0.1 * i, 50 + side, 0, 7));
      tests::place(world, box, core, {0, 0, 5.0 * i});
      tests::place(world, world.top, box, {50.0 * side, -80 + 32.0 * i, 0});
    }
  }
  finish(world);
  return world;
}

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
  const auto world = std::make_shared<const World>(two_regions());
  RuntimeOptions options = tests::eager_options(JitMode::on);
  options.specialiser.min_steps = 100;
  Runtime runtime(world, options);
  Runtime generic(world, tests::eager_options(JitMode::off));
  Navigator navigator = runtime.navigator(), reference = generic.navigator();
  const auto run = [&](int side) {
    for (int pass = 0; pass < 6; ++pass) {
      for (const Ray& ray : rays_in_half(*world, 40 + static_cast<std::uint64_t>(side), side)) {
        EXPECT_TRUE(tests::same_bits(tests::trace(navigator, ray, world->tolerance),
                                     tests::trace(reference, ray, world->tolerance)));
      }
      runtime.wait_until_idle();
    }
  };
  run(-1);
  const std::set<std::string> first = specialised(runtime);
  EXPECT_GT(first.size(), 6U);
  for (const std::string& name : first) EXPECT_FALSE(name.starts_with("right")) << name;
  run(1);
  const std::set<std::string> both = specialised(runtime);
  EXPECT_GT(both.size(), first.size() + 6);
}

TEST(Phases, WaitingIsForAllThatIsDue) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  RuntimeOptions options = tests::eager_options(JitMode::on);
  options.specialiser.batch = 1;
  options.specialiser.min_steps = 50;
  Runtime runtime(world, options);
  {
    Navigator navigator = runtime.navigator();
    for (const Ray& ray : tests::rays_through(*world, 9, 2000)) {
      tests::trace(navigator, ray, world->tolerance);
    }
  }
  runtime.wait_until_idle();
  std::size_t hot = 0;
  for (const SceneReport& scene : runtime.report().scenes) {
    if (scene.steps < options.specialiser.min_steps) continue;
    ++hot;
    EXPECT_NE(scene.status, SceneStatus::generic) << scene.volume;
    EXPECT_NE(scene.status, SceneStatus::compiling) << scene.volume;
  }
  EXPECT_GT(hot, 5U);
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
