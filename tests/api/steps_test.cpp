// Several boundaries in one call give the same steps as one by one, bit for bit.
#include <gtest/gtest.h>

#include "navjit/errors.hpp"
#include "tests/support/traces.hpp"

namespace navjit {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool same(const Step& a, const Step& b) {
  return kernels::same_bits(a.length, b.length) && a.boundary == b.boundary && a.next == b.next &&
         (!a.next.inside() || a.next.volume() == b.next.volume());
}

/// The steps of a ray, one by one, until `limit` mm are covered in all, and where they end.
struct OneByOne {
  std::vector<Step> steps;
  Vec3 point;
  double left;

  OneByOne(Navigator& navigator, const Ray& ray, double limit) : point(ray.position), left(limit) {
    for (State state = navigator.locate(point, ray.direction); state.inside();) {
      const Step step = navigator.step(state, point, ray.direction, left);
      steps.push_back(step);
      point.x += step.length * ray.direction.x;
      point.y += step.length * ray.direction.y;
      point.z += step.length * ray.direction.z;
      left -= step.length;
      state = step.next;
      if (!step.boundary || !(left > 0)) break;
    }
  }
};

class SeveralSteps : public ::testing::Test {
 protected:
  std::shared_ptr<const World> world_ = std::make_shared<const World>(tests::mixed_world());

  /// All steps of a ray, in as many calls as the buffer asks for.
  static void expect_as_one_by_one(Navigator& one, Navigator& several, const Ray& ray, double limit,
                                   std::size_t room) {
    const OneByOne right(one, ray, limit);
    Vec3 point = ray.position;
    double left = limit;
    std::vector<Step> buffer(room), made;
    for (State state = several.locate(point, ray.direction); state.inside();) {
      const auto some = several.steps(state, point, ray.direction, left, buffer);
      ASSERT_FALSE(some.empty());
      ASSERT_EQ(some.data(), buffer.data());
      made.insert(made.end(), some.begin(), some.end());
      state = some.back().next;
      if (!some.back().boundary || !(left > 0)) break;
      ASSERT_TRUE(some.size() == room || !state.inside()) << "it stopped before its time";
    }
    ASSERT_EQ(made.size(), right.steps.size());
    for (std::size_t i = 0; i < made.size(); ++i) {
      EXPECT_TRUE(same(made[i], right.steps[i])) << "step " << i;
    }
    EXPECT_TRUE(kernels::same_bits(point.x, right.point.x) &&
                kernels::same_bits(point.y, right.point.y) &&
                kernels::same_bits(point.z, right.point.z));
    EXPECT_TRUE(kernels::same_bits(left, right.left));
  }

  void expect_as_one_by_one(Runtime& runtime) const {
    Runtime generic(world_, {.jit = JitMode::off});
    Navigator one = generic.navigator(), several = runtime.navigator();
    const std::vector<Ray> rays = tests::rays_through(*world_, 31, 400);
    for (const std::size_t room : {1U, 2U, 7U, 200U}) {
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const double limits[] = {infinity, 0, 1, 100, 1000};
        SCOPED_TRACE(i);
        expect_as_one_by_one(one, several, rays[i], limits[i % 5], room);
        if (::testing::Test::HasFatalFailure()) return;
      }
    }
  }
};

TEST_F(SeveralSteps, AreThoseOfOneByOneGenerically) {
  Runtime runtime(world_, {.jit = JitMode::off});
  expect_as_one_by_one(runtime);
}

TEST_F(SeveralSteps, AreThoseOfOneByOneSpecialised) {
  Runtime runtime(world_, tests::eager_options(JitMode::wait));
  expect_as_one_by_one(runtime);
  EXPECT_GT(tests::share_specialised(runtime), 0.5);
}

TEST_F(SeveralSteps, AreThoseOfOneByOneInShadowMode) {
  Runtime runtime(world_, tests::eager_options(JitMode::shadow));
  expect_as_one_by_one(runtime);
}

TEST_F(SeveralSteps, AreProfiled) {
  Runtime runtime(world_, {.jit = JitMode::off});
  Navigator navigator = runtime.navigator();
  std::vector<Step> buffer(64);
  std::uint64_t steps = 0;
  for (const Ray& ray : tests::rays_through(*world_, 5, 500)) {
    Vec3 point = ray.position;
    double limit = infinity;
    for (State state = navigator.locate(point, ray.direction); state.inside();) {
      const auto made = navigator.steps(state, point, ray.direction, limit, buffer);
      steps += made.size();
      state = made.back().next;
    }
  }
  std::uint64_t counted = 0;
  for (const SceneReport& scene : runtime.report().scenes) counted += scene.steps;
  EXPECT_GT(steps, 1000U);
  EXPECT_EQ(counted, steps);
}

TEST_F(SeveralSteps, InTheBallOfASafetyThereIsOne) {
  Runtime runtime(world_, {.jit = JitMode::off});
  Navigator navigator = runtime.navigator();
  std::vector<Step> buffer(8);
  for (const Ray& ray : tests::rays_through(*world_, 3, 50)) {
    const State state = navigator.locate(ray.position, ray.direction);
    if (!state.inside()) continue;
    const double safety = navigator.safety(state, ray.position);
    if (!(safety > 0)) continue;
    const std::uint64_t before = navigator.counts().within_safety;
    Vec3 point = ray.position;
    double limit = safety / 2;
    const auto made = navigator.steps(state, point, ray.direction, limit, buffer);
    ASSERT_EQ(made.size(), 1U);
    EXPECT_FALSE(made[0].boundary);
    EXPECT_EQ(made[0].length, safety / 2);
    EXPECT_EQ(limit, 0);
    EXPECT_TRUE(made[0].next == state);
    EXPECT_EQ(navigator.counts().within_safety, before + 1);
  }
}

TEST_F(SeveralSteps, BadArgumentsMoveNothing) {
  Runtime runtime(world_, {.jit = JitMode::off});
  Navigator navigator = runtime.navigator();
  const Ray ray = tests::rays_through(*world_, 3, 1)[0];
  const State state = navigator.locate(ray.position, ray.direction);
  ASSERT_TRUE(state.inside());
  std::vector<Step> buffer(4);
  Vec3 point = ray.position;
  double limit = 10;
  const auto refused = [&](const State& from, const Vec3& direction, std::span<Step> room) {
    EXPECT_THROW(navigator.steps(from, point, direction, limit, room), UsageError);
    EXPECT_EQ(limit, 10);
    EXPECT_EQ(point.x, ray.position.x);
  };
  refused(state, ray.direction, {});
  refused({}, ray.direction, buffer);
  refused(state, {1, 1, 1}, buffer);
  limit = -1;
  EXPECT_THROW(navigator.steps(state, point, ray.direction, limit, buffer), UsageError);
  limit = 10;
  EXPECT_FALSE(navigator.steps(state, point, ray.direction, limit, buffer).empty());
}

}  // namespace
}  // namespace navjit
