#include "analysis/error_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/navigation/generic.hpp"
#include "geometry/reference/wide_geometry.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

/// The largest error of steps in each volume, against steps with 113 bits: rays go through the
/// world, each step from the end of the one before.
std::vector<double> measured(const World& world, int rays) {
  const auto shared = std::make_shared<const World>(world);
  const Geometry geometry(shared);
  const reference::WideGeometry reference(shared);
  std::mt19937_64 random(3);
  std::vector<double> worst(world.volumes.size(), -1);
  const auto stack = std::make_unique<NavigationStack>();
  const Extent& e = world.volumes[world.top].solid.extent;
  for (int i = 0; i < rays; ++i) {
    Vec3 p{uniform(random, e.min.x, e.max.x), uniform(random, e.min.y, e.max.y),
           uniform(random, e.min.z, e.max.z)};
    const Vec3 v = tests::random_direction(random);
    stack->depth = -1;
    generic::locate(geometry, *stack, p, v);
    for (int step = 0; stack->depth >= 0 && step < 1000; ++step) {
      const kernels::StackLevel level = stack->levels[stack->depth];
      const reference::Chain chain = reference::chain_of(world, level.touchable);
      const reference::Quad right =
          reference.step(chain, reference::widen(p), reference::widen_direction(v)).length;
      const double length = generic::step(geometry, *stack, p, v, INFINITY);
      worst[level.volume] =
          std::max(worst[level.volume], reference.across(chain, p, v, length, right));
      p += length * v;
    }
  }
  return worst;
}

/// Expects that every volume that was visited is within its bound; returns how many were.
int expect_within_bounds(const World& world, int rays) {
  const std::vector<ErrorBound> bounds = error_bounds(world);
  const std::vector<double> worst = measured(world, rays);
  int visited = 0;
  for (std::size_t v = 0; v < worst.size(); ++v) {
    if (worst[v] < 0) continue;
    ++visited;
    EXPECT_TRUE(bounds[v].known()) << world.volumes[v].name << ": " << bounds[v].unknown;
    EXPECT_LE(worst[v], bounds[v].total()) << world.volumes[v].name;
  }
  return visited;
}

TEST(ErrorBound, IsNotExceeded) {
  EXPECT_GE(expect_within_bounds(tests::mixed_world(), 3000), 7);
  EXPECT_GE(expect_within_bounds(tests::random_world(5, 3), 3000), 27);
}

TEST(ErrorBound, IsNearWhatRoundingCosts) {
  // 10 mm at the origin: some ten roundings of 20 mm, and the tolerance that is 2e-11 both ways.
  World world;
  world.top = tests::add_volume(world, "box", make_box("box", 10, 10, 10));
  finish(world);
  const ErrorBound bound = error_bounds(world)[0];
  ASSERT_TRUE(bound.known());
  EXPECT_DOUBLE_EQ(bound.tolerance, 2e-11);
  EXPECT_GT(bound.kernel + bound.frame, 2e-15);
  EXPECT_LT(bound.kernel + bound.frame, 1e-13);
}

TEST(ErrorBound, CoversRotationsThatAreNotQuite) {
  // The file's rotations are off by 4e-7, as files with few digits have them: frames are composed
  // with transposes for inverses, and that is what the bound has to know.
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 5000, 5000, 5000));
  const VolumeId outer = tests::add_volume(world, "outer", make_box("outer", 3000, 2000, 2000));
  const VolumeId middle = tests::add_volume(world, "middle", make_box("middle", 900, 900, 900));
  const VolumeId inner = tests::add_volume(world, "inner", make_tube("inner", 20, 300, 200, 0, 7));
  const double c = std::cos(0.3), s = std::sin(0.3), by = 4e-7;
  const double rotation[9] = {c + by, s, 0, -s, c - by, 0, 0, 0, 1};
  const auto place = [&](VolumeId mother, VolumeId daughter, double x) {
    Placement placement;
    placement.name = world.volumes[daughter].name;
    placement.volume = daughter;
    placement.transformation = make_transformation({x, 100, 0}, rotation);
    world.volumes[mother].daughters.push_back(placement);
  };
  place(world.top, outer, 1000);
  place(outer, middle, 1500);
  place(middle, inner, 300);
  finish(world);
  EXPECT_EQ(expect_within_bounds(world, 4000), 4);
  const std::vector<double> worst = measured(world, 4000);
  EXPECT_GT(*std::max_element(worst.begin(), worst.end()), 1e-6);  // there is something to cover
}

TEST(ErrorBound, GrowsWithTheDistanceFromTheOrigin) {
  const auto bound_at = [](double x) {
    World world;
    world.top = tests::add_volume(world, "world", make_box("world", 1e6, 1e6, 1e6));
    const VolumeId mother = tests::add_volume(world, "mother", make_box("mother", 20, 20, 20));
    const VolumeId core = tests::add_volume(world, "core", make_box("core", 1, 1, 1));
    tests::place(world, world.top, mother, {x, 0, 0}, {0.1, 0.2, 0.3});
    tests::place(world, mother, core, {1, 2, 3}, {0.3, 0.2, 0.1});
    finish(world);
    return error_bounds(world)[core];
  };
  EXPECT_GT(bound_at(9e5).frame, 100 * bound_at(1000).frame);
}

TEST(ErrorBound, SaysWhatNoBoundIsKnownOf) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 100, 100, 100));
  const VolumeId ring = tests::add_volume(world, "ring", make_torus("ring", 0, 5, 20, 0, 7));
  const VolumeId cut = tests::add_volume(
      world, "cut",
      make_subtraction("cut", make_box("b", 9, 9, 9), make_torus("t", 0, 1, 9, 0, 7)));
  const VolumeId spare = tests::add_volume(world, "spare", make_box("spare", 1, 1, 1));
  tests::place(world, world.top, ring, {0, 0, 0});
  tests::place(world, world.top, cut, {0, 0, 50});
  finish(world);
  const std::vector<ErrorBound> bounds = error_bounds(world);
  EXPECT_EQ(bounds[ring].unknown, "torus");
  EXPECT_EQ(bounds[cut].unknown, "subtraction");
  EXPECT_EQ(bounds[world.top].unknown, "torus");  // a daughter's surfaces end steps in its mother
  EXPECT_FALSE(bounds[spare].known());
  EXPECT_EQ(bounds[ring].total(), INFINITY);
}

}  // namespace
}  // namespace navjit
