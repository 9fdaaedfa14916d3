// Programs that look up points, and make few steps or none: what they ask is specialised, too.
#include <gtest/gtest.h>

#include "navjit/runtime.hpp"
#include "runtime/gather.hpp"
#include "tests/support/traces.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

RuntimeOptions without_compiler() {
  RuntimeOptions options = tests::eager_options(JitMode::on);
  options.specialiser.constants = false;
  options.specialiser.structures = false;
  options.specialiser.solids = false;
  options.specialiser.keep_only_faster = false;
  return options;
}

struct Asked {
  Vec3 point, direction;
};

std::vector<Asked> questions(std::uint64_t seed, int count) {
  std::mt19937_64 random(seed);
  std::vector<Asked> all;
  for (int i = 0; i < count; ++i) {
    const auto anywhere = [&] { return tests::uniform(random, -95, 95); };
    const double x = anywhere(), y = anywhere(), z = anywhere();
    all.push_back({{x, y, z}, tests::random_direction(random)});
  }
  return all;
}

/// Nobody made a step, and yet the report names the volumes in which points were located, with
/// what was done for them.
void expect_reported(const RuntimeReport& report, double located) {
  EXPECT_EQ(report.steps, 0U);
  ASSERT_EQ(report.scenes.size(), 4U) << "those that have daughters";
  EXPECT_EQ(report.scenes[0].volume, "world") << "each point is looked for in it first";
  EXPECT_NEAR(static_cast<double>(report.scenes[0].relocations), located, 0.05 * located);
  for (const SceneReport& scene : report.scenes) {
    EXPECT_EQ(scene.steps, 0U);
    EXPECT_EQ(scene.share, 0);
    EXPECT_GT(scene.relocations, 0U) << scene.volume;
    EXPECT_FALSE(scene.structure.empty()) << scene.volume;
    // Whether a rare one is bound as well depends on the time that it takes.
    if (scene.volume == "turned") continue;
    EXPECT_EQ(scene.binding, Binding::data) << scene.volume;
  }
}

/// `ask(navigator, question)` gives a state.
template <class Ask>
void expect_specialised(Ask ask) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  RuntimeOptions off;
  off.jit = JitMode::off;
  Runtime generic(world, off), runtime(world, without_compiler());
  Navigator right = generic.navigator(), navigator = runtime.navigator();
  for (int round = 0; round < 2; ++round) {
    for (const Asked& question : questions(7, 30'000)) {
      ASSERT_EQ(ask(navigator, question), ask(right, question));
    }
    if (round == 1) break;
    runtime.wait_until_idle();
    EXPECT_EQ(runtime.specialised(), 3U) << "the world, stacks and plates";
  }
  expect_reported(runtime.final_report(), 60'000);
}

TEST(Locations, OfAProgramThatMakesNoStepAreSpecialised) {
  expect_specialised(
      [](Navigator& navigator, const Asked& q) { return navigator.locate(q.point, q.direction); });
}

TEST(Locations, FromAHintAreSpecialisedToo) {
  expect_specialised([hint = State{}](Navigator& navigator, const Asked& q) mutable {
    const State at = navigator.relocate(hint, q.point, q.direction);
    hint = at.inside() ? State{0, 0} : at;  // the world, or nothing
    return at;
  });
}

/// Samples of `locations` points located in volume 1, and of `steps` steps, are gathered.
struct Gathered {
  std::shared_ptr<const World> world = std::make_shared<const World>(tests::mixed_world());
  std::shared_ptr<detail::Shared> shared =
      std::make_shared<detail::Shared>(world, RuntimeOptions{});
  Specialisation spec{shared};

  Gathered(int steps, int locations) {
    const auto profile = std::make_shared<Profile>(world->volumes.size());
    shared->add(profile);
    for (int i = 0; i < steps; ++i) profile->count(0);
    int sampled = 0;
    for (int i = 0; i < locations; ++i) {
      if (!profile->location_due()) continue;
      Sample sample{};
      sample.question = Question::location;
      sample.relocations[sample.relocation_count++] = {1, nullptr};
      profile->record(sample);
      ++sampled;
    }
    EXPECT_NEAR(sampled, locations / static_cast<double>(Profile::period), 1);
    gather(spec);
  }
};

TEST(Locations, CountAsRelocationsWhereTheyAreMoreThanTheSteps) {
  const Gathered many(100, 10'000);
  EXPECT_DOUBLE_EQ(many.spec.relocations[1], 10'000);
  EXPECT_EQ(many.spec.steps_made, 10'100);
  EXPECT_TRUE(many.spec.active);
  const Gathered few(10'000, 100);
  EXPECT_EQ(few.spec.relocations[1], 0);
  EXPECT_EQ(few.spec.steps_made, 10'000);
  const Gathered alone(0, 10);
  EXPECT_TRUE(alone.spec.active) << "or trials would wait";
}

}  // namespace
}  // namespace navjit
