// What a ray has left for good: specialised navigators note it when they leave it, and do not ask
// it again along that ray. They answer as the generic navigator does, which asks all daughters.
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <vector>

#include "geometry/navigation/generic.hpp"
#include "geometry/navigation/left_for_good.hpp"
#include "tests/runtime/bound_world.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

using kernels::LeftForGood;

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// A bound world that records what is known to be left for good.
struct Bound : tests::BoundWorld {
  using BoundWorld::BoundWorld;

  unsigned left(const NavigationStack& stack, const Vec3& p) const {
    return kernels::left_for_good(stack, p.x, p.y, p.z, geometry.tolerance());
  }
};

struct Walked {
  std::size_t steps = 0, out = 0, known = 0, found = 0;
};

/// Steps, some limited and some turned aside, compared with those of the generic navigator.
Walked walk(const Bound& bound, std::uint64_t seed, int rays) {
  const Geometry& geometry = bound.geometry;
  const auto right = std::make_unique<NavigationStack>(), got = std::make_unique<NavigationStack>();
  std::mt19937_64 random(seed);
  const double half = geometry.world().volumes[geometry.world().top].solid.extent.max.x;
  Walked walked;
  for (int ray = 0; ray < rays; ++ray) {
    Vec3 p{uniform(random, -half, half), uniform(random, -half, half),
           uniform(random, -half, half)};
    Vec3 v = tests::random_direction(random);
    generic::locate(geometry, *right, p, v);
    generic::locate(geometry, *got, p, v);
    for (int n = 0; n < 200 && right->depth >= 0; ++n) {
      const double limit = random() % 4 == 0 ? uniform(random, 0, half / 4) : unlimited;
      if (n > 0) {
        walked.known += bound.left(*got, p) != LeftForGood::none ? 1 : 0;
        walked.found += find_left_for_good(geometry, *right, p) != LeftForGood::none ? 1 : 0;
      }
      const int depth = right->depth;
      const auto [length, same] = bound.step_both(*right, *got, p, v, limit);
      EXPECT_TRUE(same) << "ray " << ray << ", step " << n;
      if (!same) return walked;
      ++walked.steps;
      if (right->depth == depth - 1 && right->depth >= 0) ++walked.out;
      p += length * v;
      if (random() % 5 == 0) v = tests::random_direction(random);
    }
  }
  return walked;
}

TEST(LeftForGood, IsNotedAndChangesNoAnswer) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Walked walked = walk(Bound(tests::random_world(seed, 3)), seed, 6000);
    EXPECT_GT(2 * walked.known, walked.out) << "it is noted";
    EXPECT_GT(walked.out, 300U);
    EXPECT_GT(10 * walked.found, 9 * walked.known) << "and found from the geometry alone";
  }
  const Walked walked = walk(Bound(tests::mixed_world()), 4, 6000);
  EXPECT_GT(walked.known, 500U);
}

/// Boxes and tubes over one another: those that reach out of their mother among them.
TEST(LeftForGood, ChangesNoAnswerWhereVolumesOverlap) {
  for (const std::uint64_t seed : {5, 6, 7, 8}) {
    std::mt19937_64 random(seed);
    World world;
    world.top = tests::add_volume(world, "world", make_box("world", 20, 20, 20));
    const VolumeId inner = tests::add_volume(world, "inner", make_tube("inner", 1, 3, 2, 0, 7));
    const int outer = 3 + static_cast<int>(random() % 20);
    for (int i = 0; i < outer; ++i) {
      const std::string name = "v" + std::to_string(i);
      const VolumeId v = tests::add_volume(world, name, make_box(name, 4, 2, 1.0 + i % 6));
      tests::place(world, v, inner, {2, 1, 0});
      tests::place(world, world.top, v,
                   {uniform(random, -18, 18), uniform(random, -18, 18), uniform(random, -18, 18)},
                   {0, 0, i % 3 == 0 ? uniform(random, 0, 3) : 0.0});
    }
    finish(world);
    const Walked walked = walk(Bound(std::move(world)), seed, 6000);
    EXPECT_GT(walked.known, 100U);
  }
}

/// One box in another, and a track that has just come out of the inner one.
struct Out : testing::Test {
  static World world() {
    World world;
    world.top = tests::add_volume(world, "world", make_box("world", 10, 10, 10));
    tests::place(world, world.top, tests::add_volume(world, "box", make_box("box", 1, 2, 3)),
                 {1, 0, 0});
    finish(world);
    return world;
  }

  Bound bound{world()};
  std::unique_ptr<NavigationStack> stack = std::make_unique<NavigationStack>();
  Vec3 v{0.6, 0.64, 0.48}, out{0, 0, 0};

  void SetUp() override {
    const Vec3 start{1, 0, 0};
    generic::locate(bound.geometry, *stack, start, v);
    out = start + bound.step(*stack, start, v, unlimited) * v;
    ASSERT_EQ(stack->depth, 0);
  }
};

TEST_F(Out, IsKnownWhereItCameOut) {
  EXPECT_EQ(bound.left(*stack, out), 0U);
  const double near = 0.2 * bound.geometry.tolerance();
  EXPECT_EQ(bound.left(*stack, out + Vec3{near, -near, near}), 0U);
}

TEST_F(Out, IsNotKnownElsewhereNorAlongAnotherRay) {
  EXPECT_EQ(bound.left(*stack, out + Vec3{0, 0, 1e-6}), LeftForGood::none);
  kernels::set_ray(*stack, v.x, v.y, v.z);
  EXPECT_EQ(bound.left(*stack, out), 0U) << "the same ray";
  kernels::set_ray(*stack, v.x, v.y, -v.z);
  EXPECT_EQ(bound.left(*stack, out), LeftForGood::none);
}

TEST_F(Out, IsForgottenWithTheTouchable) {
  generic::restore(bound.geometry, *stack, 0);
  EXPECT_EQ(bound.left(*stack, out), LeftForGood::none);
}

TEST_F(Out, IsNotCopied) {
  NavigationStack other{};
  copy(*stack, other);
  EXPECT_EQ(bound.left(other, out), LeftForGood::none);
}

/// A photon that turned within the tolerance of the face may be behind it.
TEST_F(Out, IsNotKnownAfterAStepOfNoLength) {
  kernels::set_ray(*stack, -v.x, -v.y, -v.z);
  const Vec3 back = -1.0 * v;
  const double in = bound.step(*stack, out, back, unlimited);
  ASSERT_EQ(in, 0);
  ASSERT_EQ(stack->depth, 1);
  ASSERT_EQ(bound.step(*stack, out, v, unlimited), 0);
  ASSERT_EQ(stack->depth, 0);
  EXPECT_EQ(bound.left(*stack, out), LeftForGood::none);
}

}  // namespace
}  // namespace navjit
