// What a detector tells about its states is compared with navigation.
#include "navjit/detector.hpp"

#include <gtest/gtest.h>

#include "navjit/runtime.hpp"
#include "tests/support/traces.hpp"

namespace navjit {
namespace {

constexpr JitMode off = JitMode::off;

/// Calls check(navigator, state, point) for states in all parts of the mixed world.
template <class Check>
void for_states(const Detector& detector, const Check& check) {
  Runtime runtime{detector, {.jit = off}};
  Navigator navigator = runtime.navigator();
  std::size_t deepest = 0, count = 0;
  for (const Ray& ray : tests::rays_through(*detector.model(), 3, 300)) {
    Vec3 point = ray.position;
    for (State state = navigator.locate(point, ray.direction); state.inside(); ++count) {
      check(navigator, state, point);
      deepest = std::max(deepest, static_cast<std::size_t>(detector.depth(state)));
      const Step step = navigator.step(state, point, ray.direction);
      point += step.length * ray.direction;
      state = step.next;
    }
  }
  EXPECT_GT(count, 300U);
  EXPECT_EQ(deepest, 3U);
}

TEST(Detector, TellsVolumesAndMaterials) {
  const Detector detector{tests::mixed_world()};
  EXPECT_EQ(detector.volumes(), 8U);
  EXPECT_EQ(detector.levels(), 4);
  EXPECT_EQ(detector.volume(detector.world_volume()).name, "world");
  EXPECT_EQ(detector.find_volume("hole"), VolumeId{3});
  EXPECT_FALSE(detector.find_volume("nobody"));
  EXPECT_THROW(detector.volume(8), UsageError);
  EXPECT_THROW(detector.material(0), UsageError);
  EXPECT_EQ(detector.material(detector.volume(0)).density, 0);
  EXPECT_GT(detector.tolerance(), 0);
  EXPECT_EQ(detector.touchables(), 1 + 4 * (1 + 10 * 17 + 10) + 10 * 2 + 2U);
}

TEST(Detector, WaysDownTheTreeLeadBack) {
  const Detector detector{tests::mixed_world()};
  for_states(detector, [&](Navigator&, const State& state, const Vec3&) {
    const std::vector<std::uint32_t> path = detector.path(state);
    EXPECT_EQ(static_cast<int>(path.size()), detector.depth(state));
    EXPECT_EQ(detector.state_at(path), state);
    EXPECT_EQ(detector.state_at(path).volume(), state.volume());
    EXPECT_EQ(detector.ancestor(state, detector.depth(state)), state);
    std::string words = detector.volume(detector.world_volume()).name;
    std::vector<NamedPlacement> names;
    State at = detector.state_at(std::vector<std::uint32_t>{});
    EXPECT_EQ(detector.placement(at), nullptr);
    EXPECT_FALSE(detector.mother(at).inside());
    for (std::size_t i = 0; i < path.size(); ++i) {
      EXPECT_EQ(detector.ancestor(state, static_cast<int>(i)), at);
      const State next = detector.state_at(std::span(path).first(i + 1));
      EXPECT_EQ(detector.mother(next), at);
      EXPECT_EQ(detector.placement(next), &detector.volume(at).daughters[path[i]]);
      names.push_back({detector.placement(next)->name, detector.copy_number(next)});
      words += "/" + names.back().name;
      at = next;
    }
    EXPECT_EQ(at, state);
    EXPECT_EQ(detector.state_at(names), state);
    EXPECT_EQ(detector.path_of(state), words);
  });
}

TEST(Detector, FramesAreThoseOfNavigationBitForBit) {
  const Detector detector{tests::mixed_world()};
  for_states(detector, [&](Navigator& navigator, const State& state, const Vec3& point) {
    const Transformation frame = detector.frame(state);
    EXPECT_EQ(navigator.frame(state), frame);
    for (int depth = 0; depth <= detector.depth(state); ++depth) {
      EXPECT_EQ(navigator.frame(state, depth), detector.frame(detector.ancestor(state, depth)));
    }
    const Vec3 local = navigator.to_local(state, point);
    EXPECT_EQ(local, to_local(frame, point));
    // In the solid, and back again.
    const Extent& e = detector.volume(state).solid.extent;
    for (const auto& [x, low, high] :
         {std::tuple{local.x, e.min.x, e.max.x}, std::tuple{local.y, e.min.y, e.max.y},
          std::tuple{local.z, e.min.z, e.max.z}}) {
      EXPECT_GE(x, low - 1e-9);
      EXPECT_LE(x, high + 1e-9);
    }
    EXPECT_LT(norm(navigator.to_global(state, local) - point), 1e-11);
    const Vec3 direction{0.6, 0, 0.8};
    const Vec3 turned = navigator.direction_to_local(state, direction);
    EXPECT_NEAR(norm(turned), 1, 1e-14);
    EXPECT_LT(norm(navigator.direction_to_global(state, turned) - direction), 1e-14);
    // A direction is the difference of two points.
    EXPECT_LT(norm(navigator.to_local(state, point + direction) - local - turned), 1e-12);
  });
}

TEST(Detector, RefusesStatesThatAreNotItsOwn) {
  const Detector detector{tests::mixed_world()};
  for (const State& bad : {State{}, State{1'000'000, 0}, State{0, 3}, State{0, 1000}}) {
    EXPECT_THROW(detector.depth(bad), UsageError);
    EXPECT_THROW(detector.frame(bad), UsageError);
    EXPECT_THROW(detector.path(bad), UsageError);
    EXPECT_THROW(detector.mother(bad), UsageError);
  }
  EXPECT_THROW(detector.path_of(State{}), UsageError);
  EXPECT_THROW(detector.volume(State{}), UsageError);
  EXPECT_THROW(detector.material(State{}), UsageError);
  const State world = detector.state_at(std::vector<std::uint32_t>{});
  EXPECT_THROW(detector.ancestor(world, 1), UsageError);
  EXPECT_THROW(detector.ancestor(world, -1), UsageError);
  EXPECT_THROW(detector.state_at(std::vector<std::uint32_t>{16}), UsageError);
  EXPECT_THROW(detector.state_at(std::vector<NamedPlacement>{{"stack_0", 7}}), UsageError);
  EXPECT_EQ(detector.depth(detector.state_at(std::vector<NamedPlacement>{{"stack_0", 0}})), 1);
  EXPECT_THROW(Detector{std::shared_ptr<const World>()}, GeometryError);
  EXPECT_THROW(Detector{World{}}, GeometryError);
}

}  // namespace
}  // namespace navjit
