// Steps within safety spheres, and relocation from a hint.
#include "navjit/navigator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "navjit/runtime.hpp"
#include "tests/support/traces.hpp"

namespace navjit {
namespace {

using tests::uniform;

class NavigatorApi : public ::testing::TestWithParam<JitMode> {
 protected:
  NavigatorApi()
      : runtime_(tests::mixed_world(), {.jit = GetParam()}),
        navigator_(runtime_.navigator()),
        plain_(runtime_.navigator()) {}

  Vec3 anywhere() {
    return {uniform(random_, -99, 99), uniform(random_, -99, 99), uniform(random_, -99, 99)};
  }

  Runtime runtime_;
  Navigator navigator_, plain_;  ///< the second is never asked for a safety
  std::mt19937_64 random_{5};
};

TEST_P(NavigatorApi, StepsWithinASphereAreTheStepsWithout) {
  int within = 0, beyond = 0;
  for (int i = 0; i < 3000; ++i) {
    Vec3 point = anywhere();
    const State state = navigator_.locate(point, {0, 0, 1});
    const SafetySphere sphere = navigator_.safety_sphere(state, point);
    EXPECT_EQ(sphere.radius, navigator_.safety(state, point));
    EXPECT_EQ(sphere.safety(state, point), sphere.radius);
    // Several steps, as of a particle that scatters: each from where the last one ended.
    State at = state;
    for (int n = 0; n < 5 && at.inside(); ++n) {
      const Vec3 direction = tests::random_direction(random_);
      const double limit = uniform(random_, 0, 1.2) * sphere.radius;
      const Step right = plain_.step(at, point, direction, limit);
      const Step step = navigator_.step(at, point, direction, limit, sphere);
      EXPECT_TRUE(kernels::same_bits(step.length, right.length));
      EXPECT_EQ(step.boundary, right.boundary);
      EXPECT_EQ(step.next, right.next);
      const double left = sphere.safety(at, point);
      ++(limit < left ? within : beyond);
      if (std::abs(limit - left) > 1e-9 * sphere.radius) {
        EXPECT_EQ(sphere.holds(at, point, limit), limit < left);
      }
      EXPECT_LE(sphere.safety(at, point), navigator_.safety(at, point) + 1e-9 + sphere.radius);
      point += step.length * direction;
      at = step.next;
    }
  }
  EXPECT_GT(within, 1000);
  EXPECT_GT(beyond, 1000);
}

TEST_P(NavigatorApi, StepsWithinTheLastSafetyAreTheStepsOfOneWhoNeverAsked) {
  // Particles that scatter, as simulations make them: the safety, a step, another direction.
  std::uint64_t steps = 0, boundaries = 0;
  for (int i = 0; i < 300; ++i) {
    Vec3 point = anywhere();
    Vec3 direction = tests::random_direction(random_);
    State at = navigator_.locate(point, direction);
    for (int n = 0; n < 40 && at.inside(); ++n) {
      // Now and then the ball is one of some steps before, or of another state.
      if (n % 5 != 4) navigator_.safety(at, point);
      const double limit = -5 * std::log(1 - uniform(random_, 0, 1));
      const Step right = plain_.step(at, point, direction, limit);
      const Step step = navigator_.step(at, point, direction, limit);
      ASSERT_TRUE(kernels::same_bits(step.length, right.length));
      ASSERT_EQ(step.boundary, right.boundary);
      ASSERT_EQ(step.next, right.next);
      point += step.length * direction;
      at = step.next;
      ++steps;
      boundaries += step.boundary;
      if (!step.boundary) direction = tests::random_direction(random_);
    }
  }
  EXPECT_GT(boundaries, 500U);
  EXPECT_EQ(plain_.counts().within_safety, 0U);
  const std::uint64_t within = navigator_.counts().within_safety;
  if (GetParam() == JitMode::shadow) {
    EXPECT_EQ(within, 0U) << "all steps are to be compared";
  } else {
    EXPECT_GT(within, steps / 4);
  }
}

TEST_P(NavigatorApi, AStepWithinTheSafetyTrustsNoVolumeThatItIsGiven) {
  const Vec3 point{90, 90, 90}, direction{0, 0, 1};
  const State state = navigator_.locate(point, direction);
  ASSERT_GT(navigator_.safety(state, point), 0.01);
  const State false_one(state.touchable(), state.volume() + 1'000'000'000);
  if (GetParam() == JitMode::shadow) {
    EXPECT_THROW(navigator_.step(false_one, point, direction, 0.001), UsageError);
    return;
  }
  EXPECT_EQ(navigator_.step(false_one, point, direction, 0.001).next.volume(), state.volume());
}

TEST_P(NavigatorApi, ASafetyIsToldAsFarAsItIsEnough) {
  std::size_t less = 0, all = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 point = anywhere();
    const State state = navigator_.locate(point, tests::random_direction(random_));
    if (!state.inside()) continue;
    const double whole = navigator_.safety(state, point);
    for (const double enough : {0.0, whole, 3 * uniform(random_, 0, 1) * whole, 1e300}) {
      const double told = navigator_.safety(state, point, enough);
      ASSERT_TRUE(kernels::same_bits(told, std::min(whole, enough))) << whole << " " << enough;
      ++(enough < whole ? less : all);
      if (!(told > 0)) continue;
      // What was enough for a step is enough for the navigator, too.
      const std::uint64_t before = navigator_.counts().within_safety;
      const Step step = navigator_.step(state, point, tests::random_direction(random_), told);
      EXPECT_EQ(step.length, told);
      EXPECT_FALSE(step.boundary);
      EXPECT_EQ(navigator_.counts().within_safety,
                before + (GetParam() == JitMode::shadow ? 0 : 1));
    }
  }
  EXPECT_GT(less, 1000U);
  EXPECT_GT(all, 1000U);
  const Vec3 point{-60, -40, 4};
  const State state = navigator_.locate(point);
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(navigator_.safety(state, point, bad), UsageError);
  }
}

TEST_P(NavigatorApi, StepsWithinTheLastSafetyAreRefusedAsOthers) {
  const Vec3 point{-60, -40, 4};  // in the midst of a tile
  const State state = navigator_.locate(point, {0, 0, 1});
  const double least = 0.5 * navigator_.safety(state, point);
  ASSERT_GT(least, 0);
  EXPECT_EQ(navigator_.step(state, point, {0, 0, 1}, least).length, least);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3& bad : {Vec3{0, 0, 0}, Vec3{0, 0, 2}, Vec3{nan, 0, 1}}) {
    EXPECT_THROW(navigator_.step(state, point, bad, least), UsageError);
  }
  EXPECT_THROW(navigator_.step(state, {nan, 0, 0}, {0, 0, 1}, least), UsageError);
  EXPECT_THROW(navigator_.step(state, point, {0, 0, 1}, -1), UsageError);
  EXPECT_THROW(navigator_.step(state, point, {0, 0, 1}, nan), UsageError);
  EXPECT_THROW(navigator_.step(State{}, point, {0, 0, 1}, least), UsageError);
}

TEST_P(NavigatorApi, ASphereIsGoodForItsOwnStateAlone) {
  const Vec3 point{-60, -40, 4};  // in the midst of a tile
  const State state = navigator_.locate(point, {0, 0, 1});
  const SafetySphere sphere = navigator_.safety_sphere(state, point);
  ASSERT_GT(sphere.radius, 0);
  EXPECT_EQ(sphere.safety(State{}, point), 0);
  EXPECT_EQ(sphere.safety(state, point + Vec3{0, 0, 2 * sphere.radius}), 0);
  EXPECT_EQ(SafetySphere{}.safety(State{}, {0, 0, 0}), 0);
  EXPECT_FALSE(sphere.holds(State{}, point, 0));
  EXPECT_FALSE(SafetySphere{}.holds(State{}, {0, 0, 0}, 0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double limit : {nan, -1.0}) {
    EXPECT_FALSE(sphere.holds(state, point, limit));
    EXPECT_THROW(navigator_.step(state, point, {0, 0, 1}, limit, sphere), UsageError);
  }
  EXPECT_THROW(navigator_.step(state, {nan, 0, 0}, {0, 0, 1}, 0, sphere), UsageError);
}

TEST_P(NavigatorApi, RelocatesFromAnyHint) {
  State hint;
  for (int i = 0; i < 5000; ++i) {
    // Near to the last point or far from it.
    const Vec3 point = anywhere(), direction = tests::random_direction(random_);
    const State right = navigator_.locate(point, direction);
    EXPECT_EQ(navigator_.relocate(hint, point, direction), right);
    EXPECT_EQ(navigator_.relocate(State{}, point, direction), right);
    EXPECT_EQ(navigator_.relocate(right, point, direction), right);
    const Vec3 near = point + 0.3 * tests::random_direction(random_);
    EXPECT_EQ(navigator_.relocate(right, near, direction), navigator_.locate(near, direction));
    hint = right;
  }
  EXPECT_FALSE(navigator_.relocate(hint, {1000, 0, 0}, {1, 0, 0}).inside());
  // Steps go on from there.
  const Vec3 point{-60, -40, 2};
  const State state = navigator_.relocate(hint, point, {0, 0, 1});
  EXPECT_EQ(navigator_.step(state, point, {0, 0, 1}).length,
            navigator_.step(navigator_.locate(point, {0, 0, 1}), point, {0, 0, 1}).length);
}

TEST_P(NavigatorApi, LevelsAreThoseOfTheStateThatWasGiven) {
  const Detector& detector = runtime_.detector();
  const auto expect_levels = [&](const State& state) {
    const auto levels = navigator_.levels();
    if (!state.inside()) {
      EXPECT_TRUE(levels.empty());
      return;
    }
    const auto path = detector.path(state);
    ASSERT_EQ(levels.size(), path.size() + 1);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const State level = detector.ancestor(state, static_cast<int>(i));
      EXPECT_EQ(levels[i].touchable, level.touchable());
      EXPECT_EQ(levels[i].volume, level.volume());
      if (i > 0) {
        EXPECT_EQ(levels[i].daughter, path[i - 1]);
      }
    }
  };
  for (int i = 0; i < 1000; ++i) {
    Vec3 point = anywhere();
    const Vec3 direction = tests::random_direction(random_);
    State state = navigator_.locate(point, direction);
    expect_levels(state);
    for (int n = 0; n < 20 && state.inside(); ++n) {
      const Step step = navigator_.step(state, point, direction);
      expect_levels(step.next);
      point += step.length * direction;
      state = step.next;
    }
  }
  expect_levels(navigator_.relocate(State{}, {1, 2, 3}, {1, 0, 0}));
}

TEST_P(NavigatorApi, RelocationPrefersTheHintWhereSeveralHoldThePoint) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 10, 10, 10));
  const VolumeId box = tests::add_volume(world, "box", make_box("box", 2, 2, 2));
  tests::place(world, world.top, box, {-1, 0, 0});
  tests::place(world, world.top, box, {1, 0, 0});
  finish(world);
  Runtime runtime{world, {.jit = GetParam()}};
  Navigator navigator = runtime.navigator();
  const State first = navigator.locate({-2.5, 0, 0}), second = navigator.locate({2.5, 0, 0});
  ASSERT_FALSE(first == second);
  EXPECT_EQ(navigator.relocate(first, {0.5, 0, 0}, {1, 0, 0}), first);
  EXPECT_EQ(navigator.relocate(second, {0.5, 0, 0}, {1, 0, 0}), second);
  EXPECT_EQ(navigator.relocate(first, {2.5, 0, 0}, {1, 0, 0}), second);
}

TEST_P(NavigatorApi, RefusesBadArgumentsAndStaysGood) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vec3 point{-60, -40, 2};
  const State state = navigator_.locate(point);
  EXPECT_THROW(navigator_.relocate(state, {nan, 0, 0}, {0, 0, 1}), UsageError);
  EXPECT_THROW(navigator_.relocate(state, point, {0, nan, 1}), UsageError);
  EXPECT_THROW(navigator_.relocate(State{1'000'000, 0}, point, {0, 0, 1}), UsageError);
  EXPECT_THROW(navigator_.frame(State{}), UsageError);
  EXPECT_THROW(navigator_.frame(state, 9), UsageError);
  EXPECT_THROW(navigator_.frame(state, -1), UsageError);
  EXPECT_THROW(navigator_.to_local(State{1'000'000, 0}, point), UsageError);
  EXPECT_THROW(navigator_.safety_sphere(State{}, point), UsageError);
  EXPECT_EQ(navigator_.locate(point), state);
}

INSTANTIATE_TEST_SUITE_P(Modes, NavigatorApi,
                         ::testing::Values(JitMode::off, JitMode::wait, JitMode::shadow),
                         [](const auto& mode) {
                           return mode.param == JitMode::off    ? "Generic"
                                  : mode.param == JitMode::wait ? "Specialised"
                                                                : "Compared";
                         });

}  // namespace
}  // namespace navjit
