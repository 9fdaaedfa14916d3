// How the runtime answers callers that break its rules: an exception says which rule, and nothing
// is damaged.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "navjit/runtime.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
const Vec3 point{-60, -40, 2}, direction{0.6, 0, 0.8};

/// The message of an exception of that type; empty if there is none.
template <class Exception, class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Exception& error) {
    return error.what();
  }
  return "";
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

TEST(RuntimeContract, RefusesAWorldThatIsNotThere) {
  const auto message =
      message_of<GeometryError>([] { Runtime runtime{std::shared_ptr<const World>()}; });
  EXPECT_TRUE(has(message, "null")) << message;
}

TEST(RuntimeContract, RefusesAWorldThatIsNotFinished) {
  const auto refuses = [](const World& world) {
    const auto message = message_of<GeometryError>([&] { Runtime runtime{world}; });
    EXPECT_TRUE(has(message, "navjit::finish")) << message;
  };
  refuses(World{});
  World world = tests::mixed_world();
  EXPECT_TRUE(is_finished(world));
  world.volumes[1].daughters.pop_back();
  refuses(world);
  world = tests::mixed_world();
  world.volumes[1].daughters[0].volume = 1000;
  refuses(world);
  world = tests::mixed_world();
  world.top = 1000;
  refuses(world);
  world = tests::mixed_world();
  tests::place(world, 0, 0, {0, 0, 0});  // a cycle
  refuses(world);
  world = tests::mixed_world();
  world.volumes[0].solid = {};
  refuses(world);
  world = tests::mixed_world();
  world.top = 1;
  finish(world);  // what is above is not in the tree any more
  EXPECT_TRUE(is_finished(world));
}

class Contract : public ::testing::TestWithParam<JitMode> {
 protected:
  Contract()
      : runtime_(tests::mixed_world(), {.jit = GetParam()}),
        navigator_(runtime_.navigator()),
        state_(navigator_.locate(point, direction)),
        right_(navigator_.step(state_, point, direction)) {}

  /// `call` is refused, again and again, in words; then all is as it was.
  template <class Call>
  void refused(const Call& call, const char* why) {
    // More often than steps are recorded, so that no check there can stand in for one elsewhere.
    for (int i = 0; i < 70; ++i) {
      const auto message = message_of<UsageError>(call);
      ASSERT_TRUE(has(message, why)) << message;
    }
    const Step again = navigator_.step(state_, point, direction);
    EXPECT_EQ(again.length, right_.length);
    EXPECT_EQ(again.next, right_.next);
  }

  Runtime runtime_;
  Navigator navigator_;
  State state_;
  Step right_;
};

TEST_P(Contract, DirectionsAreUnitVectors) {
  for (const Vec3& bad : {Vec3{0, 0, 0}, Vec3{0, -0.0, 0}, Vec3{0, 0, 2}, Vec3{0.3, 0, 0.4},
                          Vec3{0, 0, 1e-300}, Vec3{0, 0, 1e200}, Vec3{0, 0, 1 + 2e-5}}) {
    refused([&] { navigator_.step(state_, point, bad); }, "not a unit vector");
    Navigator fresh = runtime_.navigator();  // nor may the first direction be wrong
    const State state = fresh.locate(point);
    EXPECT_THROW(fresh.step(state, point, bad), UsageError);
  }
  for (const double bad : {nan, infinity, -infinity}) {
    refused([&] { navigator_.step(state_, point, {0, bad, 0}); }, "the direction is not finite");
    Navigator fresh = runtime_.navigator();
    const State state = fresh.locate(point);
    EXPECT_THROW(fresh.step(state, point, {bad, bad, bad}), UsageError);
  }
  // Rounding is not held against anybody, that of single precision included.
  const float third = 1 / std::sqrt(3.0F);
  EXPECT_NO_THROW(navigator_.step(state_, point, {third, third, third}));
  EXPECT_NO_THROW(navigator_.step(state_, point, {0, 0, 1 - 1e-6}));
}

TEST_P(Contract, LocatingTakesAnyFiniteDirection) {
  EXPECT_EQ(navigator_.locate(point, {0, 0, 0}), navigator_.locate(point));
  EXPECT_EQ(navigator_.locate(point, {0, 0, 7}), navigator_.locate(point, {0, 0, 1}));
  refused([&] { navigator_.locate(point, {nan, 0, 0}); }, "the direction is not finite");
}

TEST_P(Contract, LimitsAreNumbersFromZero) {
  for (const double bad : {nan, -nan, -infinity, -1.0, -1e-300}) {
    refused([&] { navigator_.step(state_, point, direction, bad); }, "the step limit is negative");
  }
  for (const double zero : {0.0, -0.0}) {
    const Step none = navigator_.step(state_, point, direction, zero);
    EXPECT_EQ(none.length, 0);
    EXPECT_FALSE(none.boundary);
    EXPECT_EQ(none.next, state_);
  }
  EXPECT_EQ(navigator_.step(state_, point, direction, infinity).length, right_.length);
}

TEST_P(Contract, PointsAreFinite) {
  for (const double bad : {nan, infinity, -infinity}) {
    refused([&] { navigator_.step(state_, {0, bad, 0}, direction); }, "the point is not finite");
    refused([&] { navigator_.safety(state_, {0, 0, bad}); }, "the point is not finite");
    refused([&] { navigator_.locate({bad, 0, 0}); }, "the point is not finite");
  }
}

TEST_P(Contract, StatesAreInsideTheirOwnWorld) {
  refused([&] { navigator_.step(State{}, point, direction); }, "outside the world");
  refused([&] { navigator_.safety(State{}, point); }, "outside the world");

  World large;
  large.top = tests::add_volume(large, "world", make_box("world", 100, 100, 100));
  const VolumeId other = tests::add_volume(large, "other", make_box("other", 0.1, 0.1, 0.1));
  for (int i = 0; i < 600; ++i) tests::place(large, 0, other, {-90 + 0.3 * i, 0, 0});
  finish(large);
  Runtime runtime{large, {.jit = JitMode::off}};
  Navigator theirs = runtime.navigator();
  // Beyond all touchables of this world; and within, but of another volume.
  for (const double x : {-90 + 0.3 * 599, -90 + 0.3 * 5}) {
    const State foreign = theirs.locate({x, 0, 0});
    ASSERT_EQ(foreign.volume(), other);
    refused([&] { navigator_.step(foreign, point, direction); }, "of another world");
    refused([&] { navigator_.safety(foreign, point); }, "of another world");
  }
  // The same touchable as the navigator is at, under another volume's number.
  const State mixed(state_.touchable(), state_.volume() + 1);
  refused([&] { navigator_.step(mixed, point, direction); }, "of another world");
  // A Runtime of its own on the same detector has the same states.
  Runtime again{runtime_.share_world(), {.jit = JitMode::off}};
  EXPECT_EQ(again.navigator().step(state_, point, direction).length, right_.length);
}

INSTANTIATE_TEST_SUITE_P(Modes, Contract, ::testing::Values(JitMode::off, JitMode::wait),
                         [](const auto& mode) {
                           return mode.param == JitMode::off ? "Generic" : "Specialised";
                         });

}  // namespace
}  // namespace navjit
