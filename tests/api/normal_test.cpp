// Normals of the surfaces that steps end on.
#include <gtest/gtest.h>

#include <limits>

#include "geometry/solids/normal.hpp"
#include "navjit/runtime.hpp"
#include "tests/support/traces.hpp"

namespace navjit {
namespace {

TEST(Normal, PointsOutOfWhatIsLeft) {
  for (const JitMode jit : {JitMode::off, JitMode::wait}) {
    const Detector detector{tests::mixed_world()};
    Runtime runtime{detector, {.jit = jit}};
    Navigator navigator = runtime.navigator();
    std::size_t entered = 0, left = 0, along = 0;
    for (const Ray& ray : tests::rays_through(*detector.model(), 41, 2000)) {
      Vec3 point = ray.position;
      for (State state = navigator.locate(point, ray.direction); state.inside();) {
        const Step step = navigator.step(state, point, ray.direction);
        point += step.length * ray.direction;
        const Vec3 normal = navigator.boundary_normal(state, step.next, point);
        EXPECT_NEAR(norm(normal), 1, 1e-14);
        const double out = dot(normal, ray.direction);
        // Rays through rounded coordinates run along faces, and leave through edges.
        EXPECT_GE(out, ray.direction.x == -1 || ray.direction.z == 1 ? -1e-9 : 0);
        along += std::abs(out) < 1e-9 ? 1 : 0;
        const bool in = step.next.inside() && detector.depth(step.next) > detector.depth(state);
        ++(in ? entered : left);
        if (!in) {
          EXPECT_EQ(normal, navigator.normal(state, point));
        }
        state = step.next;
      }
    }
    EXPECT_GT(entered, 200U);
    EXPECT_GT(left, 200U);
    EXPECT_LT(along, 100U);
  }
}

TEST(Normal, IsThatOfTheSolidTurnedIntoTheWorld) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 50, 50, 50));
  const VolumeId tube = tests::add_volume(world, "tube", make_tube("tube", 3, 10, 20, 0, 7));
  tests::place(world, world.top, tube, {5, -3, 2}, {0.3, -0.8, 1.1});
  finish(world);
  const Detector detector{std::move(world)};
  Runtime runtime{detector, {.jit = JitMode::off}};
  Navigator navigator = runtime.navigator();
  const State state = detector.state_at(std::vector<std::uint32_t>{0});
  const Transformation frame = detector.frame(state);
  for (const auto& [at, right] :
       {std::pair{Vec3{10, 0, 1}, Vec3{1, 0, 0}}, std::pair{Vec3{0, 3, 1}, Vec3{0, -1, 0}},
        std::pair{Vec3{5, 0, -20}, Vec3{0, 0, -1}}}) {
    const Vec3 normal = navigator.normal(state, to_outer(frame, at));
    EXPECT_LT(norm(normal - direction_to_outer(frame, right)), 1e-12);
  }
}

TEST(Normal, AsTheTrackGoesOnWhereItIs) {
  for (const JitMode jit : {JitMode::off, JitMode::wait}) {
    const Detector detector{tests::mixed_world()};
    Runtime runtime{detector, {.jit = jit}};
    Navigator navigator = runtime.navigator(), other = runtime.navigator();
    for (const Ray& ray : tests::rays_through(*detector.model(), 42, 300)) {
      Vec3 point = ray.position;
      for (State state = navigator.locate(point, ray.direction); state.inside();) {
        const Step step = navigator.step(state, point, ray.direction);
        point += step.length * ray.direction;
        // The other one has to be brought to each of them.
        EXPECT_EQ(navigator.boundary_normal(state, step.next, point),
                  other.boundary_normal(state, step.next, point));
        EXPECT_EQ(navigator.normal(state, point), other.normal(state, point));
        EXPECT_EQ(navigator.to_local(state, point), other.to_local(state, point));
        EXPECT_EQ(navigator.frame(state, 0).translation[0], 0);
        EXPECT_EQ(navigator.levels(state).back().touchable, state.touchable());
        EXPECT_EQ(navigator.levels(state).size(), detector.depth(state) + 1U);
        state = step.next;
        EXPECT_EQ(navigator.levels().empty(), !state.inside());
        if (state.inside()) {
          EXPECT_EQ(navigator.levels().back().touchable, state.touchable());
        }
      }
    }
    EXPECT_EQ(navigator.counts().restored, 0U);
  }
}

TEST(Normal, RefusesBadArguments) {
  Runtime runtime{tests::mixed_world(), {.jit = JitMode::off}};
  Navigator navigator = runtime.navigator();
  const State state = navigator.locate({0, 0, 0});
  EXPECT_THROW(navigator.normal(State{}, {0, 0, 0}), UsageError);
  EXPECT_THROW(navigator.normal(state, {std::numeric_limits<double>::quiet_NaN(), 0, 0}),
               UsageError);
  EXPECT_THROW(navigator.boundary_normal(State{}, state, {0, 0, 0}), UsageError);
  EXPECT_THROW(navigator.boundary_normal(state, State{1'000'000, 0}, {0, 0, 0}), UsageError);
  EXPECT_THROW(navigator.normal(State{state.touchable(), state.volume() + 1}, {0, 0, 0}),
               UsageError);
  EXPECT_NO_THROW(navigator.normal(state, {0, 0, 0}));
}

}  // namespace
}  // namespace navjit
