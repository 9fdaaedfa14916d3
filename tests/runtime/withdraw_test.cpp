// Navigators that turn out to be wrong, or of no use, after they were installed.
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

/// Transports the rays again and again until a scene was withdrawn, or for long enough.
void run_until_withdrawn(Runtime& runtime, const std::vector<Ray>& rays) {
  Navigator navigator = runtime.navigator();
  for (int pass = 0; pass < 200 && runtime.report().withdrawn == 0; ++pass) {
    for (const Ray& ray : rays) tests::trace(navigator, ray, runtime.world().tolerance);
    runtime.wait_until_idle();
  }
}

TEST(Withdraw, ANavigatorThatKeepsDecliningIsTakenOut) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  RuntimeOptions options = looking_often();
  options.faults.edit_source = [](std::string& source) {
    replace_all(source, "  if (best == 0) return -1.0;\n", "  if (best >= 0) return -1.0;\n");
  };
  Runtime runtime(world, options);
  run_until_withdrawn(runtime, tests::rays_through(*world, 31, 400));
  EXPECT_GT(runtime.report().withdrawn, 0U);
  std::size_t withdrawn = 0;
  for (const SceneReport& scene : runtime.report().scenes) {
    withdrawn += scene.note.find("declined") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(withdrawn, runtime.report().withdrawn);
}

TEST(Withdraw, ANavigatorThatIsWrongWhereNobodyTriedItIsTakenOut) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  RuntimeOptions options = looking_often();
  options.faults.edit_source = [](std::string& source) {
    replace_all(source, "  return best;\n", "  return u == 0.6 ? best * (1 + 0x1p-52) : best;\n");
  };
  Runtime generic(world, tests::eager_options(JitMode::off)), runtime(world, options);
  const std::vector<Ray> usual = tests::rays_through(*world, 33, 400);
  std::vector<Ray> unusual = usual;
  for (Ray& ray : unusual) ray.direction = {0.6, 0.8, 0};
  {
    Navigator navigator = runtime.navigator();
    for (int pass = 0; pass < 3; ++pass) {
      for (const Ray& ray : usual) tests::trace(navigator, ray, world->tolerance);
      runtime.wait_until_idle();
    }
  }
  EXPECT_EQ(runtime.report().withdrawn, 0U);
  run_until_withdrawn(runtime, unusual);
  EXPECT_GT(runtime.report().withdrawn, 0U);
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

TEST(Withdraw, GoodNavigatorsStay) {
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
  EXPECT_EQ(runtime.report().withdrawn, 0U);
}

}  // namespace
}  // namespace navjit
