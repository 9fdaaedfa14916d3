// NaN and infinity in every argument are refused clearly, and nothing is damaged.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

#include "navjit/runtime.hpp"
#include "tests/support/worlds.hpp"

namespace navjit::extremes {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The point and the direction with one number after the other replaced by a bad one.
void with_each_number_bad(const Vec3& point, const Vec3& direction,
                          const std::function<void(const Vec3&, const Vec3&)>& use) {
  for (const double bad : {nan, infinity, -infinity}) {
    for (int i = 0; i < 6; ++i) {
      Vec3 p = point, v = direction;
      double* const numbers[6] = {&p.x, &p.y, &p.z, &v.x, &v.y, &v.z};
      *numbers[i] = bad;
      use(p, v);
    }
  }
}

class NotFinite : public ::testing::TestWithParam<JitMode> {
 protected:
  NotFinite() : runtime_(tests::mixed_world(), options()), navigator_(runtime_.navigator()) {}
  static RuntimeOptions options() {
    RuntimeOptions options;
    options.jit = GetParam();
    return options;
  }

  Runtime runtime_;
  Navigator navigator_;
};

TEST_P(NotFinite, NumbersAreRefusedAtEveryStep) {
  const Vec3 point{-60, -40, 2}, direction{0.6, 0, 0.8};
  const State state = navigator_.locate(point, direction);
  ASSERT_TRUE(state.inside());
  const Step right = navigator_.step(state, point, direction);
  // More often than steps are sampled for the profile, so that no check there can stand in.
  for (int i = 0; i < 40; ++i) {
    with_each_number_bad(point, direction, [&](const Vec3& p, const Vec3& v) {
      EXPECT_THROW(navigator_.step(state, p, v), UsageError);
      EXPECT_THROW(navigator_.locate(p, v), UsageError);
      const bool bad_point = !(p == point);
      if (bad_point) {
        EXPECT_THROW(navigator_.locate(p), UsageError);
        EXPECT_THROW(navigator_.safety(state, p), UsageError);
      }
    });
  }
  const Step again = navigator_.step(state, point, direction);
  EXPECT_EQ(again.length, right.length);
  EXPECT_EQ(again.next, right.next);
}

TEST_P(NotFinite, LimitsThatAreNoneAreRefused) {
  const Vec3 point{-60, -40, 2}, direction{0.6, 0, 0.8};
  const State state = navigator_.locate(point, direction);
  for (const double limit : {nan, -1.0, -infinity}) {
    EXPECT_THROW(navigator_.step(state, point, direction, limit), UsageError) << limit;
  }
  const Step none = navigator_.step(state, point, direction, 0);
  EXPECT_EQ(none.length, 0);
  EXPECT_EQ(none.next, state);
}

TEST_P(NotFinite, HugeNumbersThatAreFiniteAreTaken) {
  const double huge = std::numeric_limits<double>::max();
  EXPECT_FALSE(navigator_.locate({huge, huge, huge}, {1, 0, 0}).inside());
  const Vec3 point{-60, -40, 2};
  const State state = navigator_.locate(point, {1, 0, 0});
  EXPECT_NO_THROW(navigator_.step(state, point, {1, 0, 0}, huge));
}

INSTANTIATE_TEST_SUITE_P(Modes, NotFinite, ::testing::Values(JitMode::off, JitMode::wait),
                         [](const auto& mode) {
                           return mode.param == JitMode::off ? "generic" : "specialised";
                         });

}  // namespace
}  // namespace navjit::extremes
