// Navigators that turn out to be wrong, or of no use, after they are installed.
#include <gtest/gtest.h>

#include "tests/support/traces.hpp"

namespace navjit {
namespace {

/// Replaces every occurrence; it is an error if there is none.
void replace_all(std::string& text, const std::string& old, const std::string& by) {
  std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::logic_error("nothing to replace: " + old);
  for (; at != std::string::npos; at = text.find(old, at + by.size())) {
    text.replace(at, old.size(), by);
  }
}

RuntimeOptions looking_often() {
  RuntimeOptions options = tests::eager_options(JitMode::on);
  options.specialiser.recheck_ms = 0;
  return options;
}

/// Transports the rays again and again until a scene is deoptimised, or the time is over.
void run_until_deoptimised(Runtime& runtime, const std::vector<Ray>& rays) {
  Navigator navigator = runtime.navigator();
  for (int pass = 0; pass < 200 && runtime.report().deoptimised == 0; ++pass) {
    for (const Ray& ray : rays) tests::trace(navigator, ray, runtime.world().tolerance);
    runtime.wait_until_idle();
  }
}

TEST(Deoptimise, ANavigatorThatKeepsBailingOutIsTakenOut) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  FaultyOptions options{looking_often()};
  options.faults = tests::edited([](std::string& source) {
    replace_all(source, "  if (__builtin_expect(!(best > 0), 0)) {\n",
                "  if (best < 1e300) return -1.0;\n  {\n");
  });
  FaultyRuntime runtime(world, options);
  run_until_deoptimised(runtime, tests::rays_through(*world, 31, 400));
  EXPECT_GT(runtime.report().deoptimised, 0U);
  std::size_t deoptimised = 0;
  for (const SceneReport& scene : runtime.report().scenes) {
    deoptimised += scene.note.find("bailed out") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(deoptimised, runtime.report().deoptimised);
}

TEST(Deoptimise, ANavigatorThatIsWrongWhereNobodyTriedItIsTakenOut) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  FaultyOptions options{looking_often()};
  options.faults = tests::edited([](std::string& source) {
    replace_all(source, "  return best;\n",
                "  return stack->ray.given[0] == 0.6 ? best * (1 + 0x1p-52) : best;\n");
  });
  Runtime generic(world, tests::eager_options(JitMode::off));
  FaultyRuntime runtime(world, options);
  const std::vector<Ray> usual = tests::rays_through(*world, 33, 400);
  std::vector<Ray> unusual = usual;
  for (Ray& ray : unusual) ray.direction = {0.6, 0.64, 0.48};
  {
    Navigator navigator = runtime.navigator();
    for (int pass = 0; pass < 3; ++pass) {
      for (const Ray& ray : usual) tests::trace(navigator, ray, world->tolerance);
      runtime.wait_until_idle();
    }
  }
  EXPECT_EQ(runtime.report().deoptimised, 0U);
  run_until_deoptimised(runtime, unusual);
  EXPECT_GT(runtime.report().deoptimised, 0U);
  // In the end all that these rays meet are out.
  Navigator a = generic.navigator(), b = runtime.navigator();
  bool same = false;
  for (int pass = 0; pass < 200 && !same; ++pass) {
    same = true;
    for (const Ray& ray : unusual) {
      same &= tests::same_bits(tests::trace(a, ray, world->tolerance),
                               tests::trace(b, ray, world->tolerance));
    }
    runtime.wait_until_idle();
  }
  EXPECT_TRUE(same);
}

TEST(Deoptimise, ANavigatorThatLeavesOutTooMuchIsMadeAgain) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  Runtime generic(world, tests::eager_options(JitMode::off)), runtime(world, looking_often());
  std::vector<Ray> usual = tests::rays_through(*world, 37, 400);
  std::erase_if(usual, [](const Ray& ray) { return ray.direction.x * ray.direction.y == 0; });
  std::vector<Ray> beam = usual;
  for (Ray& ray : beam) ray.direction = {0, 0, 1};
  Navigator a = generic.navigator(), b = runtime.navigator();
  for (int pass = 0; pass < 3; ++pass) {
    for (const Ray& ray : usual) tests::trace(b, ray, world->tolerance);
    runtime.wait_until_idle();
  }
  // At first navigators leave out the beam, which runs along the faces of boxes.
  std::uint64_t bail_outs = 0, steps = 0;
  std::uint64_t first = 0;
  for (int pass = 0; pass < 200; ++pass) {
    const std::uint64_t before = b.counts().bail_outs;
    steps = 0;
    for (const Ray& ray : beam) {
      const auto got = tests::trace(b, ray, world->tolerance);
      ASSERT_TRUE(tests::same_bits(tests::trace(a, ray, world->tolerance), got));
      steps += got.size();
    }
    bail_outs = b.counts().bail_outs - before;
    if (pass == 0) first = bail_outs;
    runtime.wait_until_idle();
    if (pass > 2 && bail_outs * 20 < steps) break;
  }
  EXPECT_GT(first, 0U);
  EXPECT_LT(bail_outs * 20, steps);
  EXPECT_EQ(runtime.report().deoptimised, 0U);
  std::uint64_t by_specialised = 0, all = 0;
  for (const SceneReport& scene : runtime.report().scenes) {
    all += scene.steps;
    by_specialised += scene.status == SceneStatus::specialised ? scene.steps : 0;
  }
  EXPECT_GT(2 * by_specialised, all);
}

TEST(Deoptimise, GoodNavigatorsStay) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  Runtime runtime(world, looking_often());
  Navigator navigator = runtime.navigator();
  for (int pass = 0; pass < 10; ++pass) {
    for (const Ray& ray : tests::rays_through(*world, 35, 400)) {
      tests::trace(navigator, ray, world->tolerance);
    }
    runtime.wait_until_idle();
  }
  std::size_t specialised = 0;
  for (const SceneReport& scene : runtime.report().scenes) {
    specialised += scene.status == SceneStatus::specialised ? 1 : 0;
  }
  EXPECT_GE(specialised, 3U);
  EXPECT_EQ(runtime.report().deoptimised, 0U);
}

}  // namespace
}  // namespace navjit
