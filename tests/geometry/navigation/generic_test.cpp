#include "geometry/navigation/generic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include "geometry/bvh/box_tree.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

using tests::add_volume;
using tests::place;
using tests::random_direction;
using tests::uniform;

constexpr double unlimited = std::numeric_limits<double>::infinity();

struct StepRecord {
  TouchableId touchable;
  double length;
  friend bool operator==(const StepRecord&, const StepRecord&) = default;
};

std::vector<StepRecord> trace(const Geometry& geometry, Vec3 point, const Vec3& direction) {
  const auto stack = std::make_unique<NavigationStack>();
  generic::locate(geometry, *stack, point, direction);
  std::vector<StepRecord> steps;
  while (stack->depth >= 0 && steps.size() < 10000) {
    const TouchableId touchable = stack->levels[stack->depth].touchable;
    const double length = generic::step(geometry, *stack, point, direction, unlimited);
    point += length * direction;
    steps.push_back({touchable, length});
  }
  EXPECT_LT(steps.size(), 10000U);
  return steps;
}

Geometry geometry_of(World world, GeometryOptions::Force force) {
  return Geometry(std::make_shared<const World>(std::move(world)), {force});
}

using Force = GeometryOptions::Force;

class EverySearch : public testing::TestWithParam<Force> {};

TEST_P(EverySearch, GivesTheStepsOfTheFullSearch) {
  for (const int side : {1, 2, 4}) {
    const World world = tests::random_world(static_cast<std::uint64_t>(side), side);
    const Geometry all = geometry_of(world, Force::all), other = geometry_of(world, GetParam());
    std::mt19937_64 random(7);
    for (int ray = 0; ray < 400; ++ray) {
      const double h = 10.0 * side;
      const Vec3 p{uniform(random, -h, h), uniform(random, -h, h), uniform(random, -h, h)};
      const Vec3 v = random_direction(random);
      EXPECT_EQ(trace(all, p, v), trace(other, p, v));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(GenericNavigator, EverySearch,
                         testing::Values(Force::automatic, Force::linear_boxes, Force::bvh));

/// A point is in a turned box if it is within the tolerance of all faces: beyond an edge it may be
/// farther than that from the box around the solid. Near 0 single precision has no margin to spare.
TEST_P(EverySearch, FindsPointsAtTheEdgeOfATurnedBox) {
  World world;
  world.top = add_volume(world, "world", make_box("world", 1000, 1000, 1000));
  const VolumeId box = add_volume(world, "box", make_box("box", 5, 5, 5));
  const double diagonal = 5 * std::sqrt(2.0);
  place(world, world.top, box, {diagonal, 0, 0}, {0, 0, M_PI / 4});
  for (const double x : {100, 200, 300, 400}) place(world, world.top, box, {x, 0, 0});
  finish(world);
  const Geometry all = geometry_of(world, Force::all), other = geometry_of(world, GetParam());
  const auto a = std::make_unique<NavigationStack>(), b = std::make_unique<NavigationStack>();
  const double norm = std::sqrt(0.91);
  const Vec3 v{0.9 / norm, 0.1 / norm, 0.3 / norm};
  int beyond = 0;  // the tolerance, and yet in the turned box
  for (int step = 0; step < 300; ++step) {
    const double out = step / 200.0;
    const Vec3 p{-out * world.tolerance, 1e-3 * world.tolerance, 0.3};
    generic::locate(all, *a, p, v);
    generic::locate(other, *b, p, v);
    EXPECT_EQ(a->depth, b->depth) << out;
    beyond += out > 1 && a->depth == 1 ? 1 : 0;
  }
  EXPECT_GT(beyond, 20);
}

std::vector<bvh::Structure> box_structures() {
  using enum bvh::Clustering;
  std::vector<bvh::Structure> result{{bvh::Method::linear}, {bvh::Method::wide_tree}};
  for (const bvh::Method method : {bvh::Method::two_level, bvh::Method::regular_tree}) {
    for (const bvh::Clustering clustering : {surface, k_means, furthest}) {
      result.push_back({method, clustering});
    }
  }
  return result;
}

TEST(GenericNavigator, AnswersDoNotDependOnTheBoxStructure) {
  for (const int side : {2, 5, 9}) {
    const auto world = std::make_shared<const World>(tests::random_world(99, side));
    const Geometry all(world, {Force::all}), linear(world, {Force::linear_boxes});
    for (const bvh::Structure& structure : box_structures()) {
      const Geometry other(world, {Force::bvh, structure});
      ASSERT_EQ(other.scene(world->top).boxes->structure().method, structure.method);
      std::mt19937_64 random(8);
      const auto a = std::make_unique<NavigationStack>(), b = std::make_unique<NavigationStack>();
      for (int ray = 0; ray < 150; ++ray) {
        const double h = 10.0 * side;
        const Vec3 p{uniform(random, -h, h), uniform(random, -h, h), uniform(random, -h, h)};
        const Vec3 v = random_direction(random);
        EXPECT_EQ(trace(all, p, v), trace(other, p, v)) << to_string(structure);
        generic::locate(all, *a, p, v);
        generic::locate(other, *b, p, v);
        for (const Vec3& heading : {v, Vec3{0, 0, 0}}) {
          // Anywhere, and on a face.
          const double length = a->depth < 0 ? 0 : generic::step(all, *a, p, v, unlimited);
          for (const Vec3& q : {p + length * v, p}) {
            generic::locate(all, *a, q, heading);
            generic::locate(other, *b, q, heading);
            EXPECT_TRUE(identical(*a, *b)) << to_string(structure);
          }
        }
        const double safety = generic::safety(other, *b, p);
        EXPECT_EQ(safety, generic::safety(linear, *b, p)) << to_string(structure);
        // The distance of a box may be the better bound.
        EXPECT_GE(safety, generic::safety(all, *a, p));
      }
    }
  }
}

TEST(GenericNavigator, TheBoxStructureIsChosenForAllOrByName) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  VolumeId stack = 0, turned = 0;
  for (VolumeId v = 0; v < world->volumes.size(); ++v) {
    if (world->volumes[v].name == "stack") stack = v;
    if (world->volumes[v].name == "turned") turned = v;
  }
  const bvh::Structure tree{bvh::Method::regular_tree, bvh::Clustering::k_means};
  const Geometry everywhere(world, {.boxes = tree});
  EXPECT_EQ(everywhere.scene(stack).boxes->structure(), tree);
  EXPECT_EQ(everywhere.scene(turned).search, Search::all) << "too few daughters for boxes";
  const Geometry named(world, {.boxes_of = {{"turned", tree}}});
  EXPECT_EQ(named.scene(turned).boxes->structure(), tree);
  EXPECT_NE(named.scene(stack).boxes->structure(), tree);
  EXPECT_THROW(Geometry(world, {.boxes_of = {{"nobody", tree}}}), GeometryError);
}

TEST(GenericNavigator, StepsAddUpToTheWayOutOfTheWorld) {
  const Geometry geometry = geometry_of(tests::mixed_world(), Force::automatic);
  std::mt19937_64 random(1);
  for (int ray = 0; ray < 3000; ++ray) {
    const Vec3 p{uniform(random, -100, 100), uniform(random, -100, 100),
                 uniform(random, -100, 100)};
    const Vec3 v = random_direction(random);
    double sum = 0;
    for (const StepRecord& step : trace(geometry, p, v)) {
      EXPECT_GE(step.length, 0);
      sum += step.length;
    }
    const kernels::Box<double> box{100, 100, 100};
    EXPECT_NEAR(sum, distance_to_out(box, p, kernels::make_direction(v.x, v.y, v.z), 1e-11), 1e-9);
  }
}

TEST(GenericNavigator, TheMiddleOfAStepIsInItsVolume) {
  const Geometry geometry = geometry_of(tests::mixed_world(), Force::automatic);
  std::mt19937_64 random(2);
  const auto stack = std::make_unique<NavigationStack>();
  for (int ray = 0; ray < 2000; ++ray) {
    Vec3 p{uniform(random, -100, 100), uniform(random, -100, 100), uniform(random, -100, 100)};
    const Vec3 v = random_direction(random);
    for (const StepRecord& step : trace(geometry, p, v)) {
      if (step.length > 1e-6) {
        generic::locate(geometry, *stack, p + (step.length / 2) * v, v);
        ASSERT_GE(stack->depth, 0);
        EXPECT_EQ(stack->levels[stack->depth].touchable, step.touchable);
      }
      p += step.length * v;
    }
  }
}

TEST(GenericNavigator, ALimitCutsTheStepWithoutMoving) {
  const Geometry geometry = geometry_of(tests::mixed_world(), Force::automatic);
  std::mt19937_64 random(3);
  const auto stack = std::make_unique<NavigationStack>(), cut = std::make_unique<NavigationStack>();
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p{uniform(random, -99, 99), uniform(random, -99, 99), uniform(random, -99, 99)};
    const Vec3 v = random_direction(random);
    generic::locate(geometry, *stack, p, v);
    copy(*stack, *cut);
    const TouchableId here = stack->levels[stack->depth].touchable;
    const double full = generic::step(geometry, *stack, p, v, unlimited);
    EXPECT_EQ(stack->boundary, 1);
    EXPECT_EQ(generic::step(geometry, *cut, p, v, full / 2), full / 2);
    EXPECT_EQ(cut->boundary, 0);
    EXPECT_EQ(cut->levels[cut->depth].touchable, here);
    // A limit that falls together with the boundary is a boundary.
    EXPECT_EQ(generic::step(geometry, *cut, p, v, full), full);
    EXPECT_EQ(cut->boundary, 1);
    EXPECT_TRUE(identical(*stack, *cut));
  }
}

TEST(GenericNavigator, RestoreGivesTheStackThatLocateGives) {
  const Geometry geometry = geometry_of(tests::mixed_world(), Force::automatic);
  std::mt19937_64 random(4);
  const auto located = std::make_unique<NavigationStack>(),
             restored = std::make_unique<NavigationStack>();
  restored->depth = -1;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p{uniform(random, -99, 99), uniform(random, -99, 99), uniform(random, -99, 99)};
    generic::locate(geometry, *located, p, {0, 0, 0});
    generic::restore(geometry, *restored, located->levels[located->depth].touchable);
    EXPECT_TRUE(identical(*located, *restored));
  }
}

TEST(GenericNavigator, SafetyIsBelowEveryDistance) {
  const Geometry geometry = geometry_of(tests::mixed_world(), Force::automatic);
  std::mt19937_64 random(5);
  const auto stack = std::make_unique<NavigationStack>(),
             moved = std::make_unique<NavigationStack>();
  double largest = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p{uniform(random, -99, 99), uniform(random, -99, 99), uniform(random, -99, 99)};
    generic::locate(geometry, *stack, p, {0, 0, 0});
    const double safety = generic::safety(geometry, *stack, p);
    EXPECT_GE(safety, 0);
    largest = std::max(largest, safety);
    for (int k = 0; k < 20; ++k) {
      copy(*stack, *moved);
      EXPECT_LE(safety, generic::step(geometry, *moved, p, random_direction(random), unlimited));
    }
  }
  EXPECT_GT(largest, 1);  // a bound of zero would be right and useless
}

TEST(GenericNavigator, OnTiesTheFirstDaughterInFileOrderWins) {
  World world;
  world.top = add_volume(world, "world", make_box("world", 10, 10, 10));
  const VolumeId a = add_volume(world, "a", make_box("a", 1, 1, 1));
  const VolumeId b = add_volume(world, "b", make_box("b", 1, 1, 1));
  place(world, world.top, a, {0, 0, 0});
  place(world, world.top, b, {0, 0, 0});
  finish(world);
  for (const Force force : {Force::all, Force::linear_boxes, Force::bvh}) {
    const Geometry geometry = geometry_of(world, force);
    const auto stack = std::make_unique<NavigationStack>();
    generic::locate(geometry, *stack, {-5, 0, 0}, {1, 0, 0});
    EXPECT_EQ(generic::step(geometry, *stack, {-5, 0, 0}, {1, 0, 0}, unlimited), 4);
    EXPECT_EQ(stack->levels[stack->depth].volume, a);
  }
}

TEST(GenericNavigator, LocatesOnSharedFacesAndInOverlapsByFileOrder) {
  World world;
  world.top = add_volume(world, "world", make_box("world", 10, 10, 10));
  const VolumeId a = add_volume(world, "a", make_box("a", 1, 1, 1));
  const VolumeId b = add_volume(world, "b", make_box("b", 1, 1, 1));
  place(world, world.top, a, {-1, 0, 0});
  place(world, world.top, b, {1, 0, 0});
  place(world, world.top, a, {0, 5, 0});
  place(world, world.top, b, {0.5, 5, 0});
  finish(world);
  const Geometry geometry = geometry_of(world, Force::automatic);
  const auto stack = std::make_unique<NavigationStack>();
  const auto at = [&](const Vec3& p, const Vec3& v) {
    generic::locate(geometry, *stack, p, v);
    return stack->levels[stack->depth].volume;
  };
  EXPECT_EQ(at({0, 0, 0}, {0, 0, 0}), a);  // a shared face, no direction: the first
  EXPECT_EQ(at({0, 0, 0}, {1, 0, 0}), b);  // the direction decides
  EXPECT_EQ(at({0, 0, 0}, {-1, 0, 0}), a);
  EXPECT_EQ(at({0.2, 5, 0}, {0, 0, 0}), b);  // an overlap: the last
  EXPECT_EQ(at({0.2, 5, 0}, {1, 0, 0}), b);
}

TEST(GenericNavigator, TouchingVolumesFollowEachOtherWithoutSlivers) {
  World world;
  world.top = add_volume(world, "world", make_box("world", 10, 10, 10));
  const VolumeId plate = add_volume(world, "plate", make_box("plate", 10, 10, 0.1));
  for (int k = 0; k < 100; ++k) place(world, world.top, plate, {0, 0, -9.9 + 0.2 * k});
  finish(world);
  const Geometry geometry = geometry_of(world, Force::automatic);
  std::mt19937_64 random(6);
  for (int ray = 0; ray < 1000; ++ray) {
    Vec3 v = random_direction(random);
    v.z = std::abs(v.z) + 0.05;
    v = (1 / norm(v)) * v;
    for (const StepRecord& step : trace(geometry, {0, 0, -10}, v)) {
      EXPECT_NE(step.touchable, 0U);  // never in the world volume between plates
    }
  }
}

TEST(GenericNavigator, LayersANanometreApartAreAllSeen) {
  World world;
  world.top = add_volume(world, "world", make_box("world", 3000, 3000, 3000));
  const double gap = 2.4e-7;
  const VolumeId layer = add_volume(world, "layer", make_box("layer", 100, 100, 1));
  place(world, world.top, layer, {2000, 0, 2500});
  place(world, world.top, layer, {2000, 0, 2502 + gap});
  finish(world);
  const Geometry geometry = geometry_of(world, Force::automatic);
  const std::vector<StepRecord> steps = trace(geometry, {2000, 0, 0}, {0, 0, 1});
  ASSERT_EQ(steps.size(), 5U);
  EXPECT_EQ(steps[2].touchable, 0U);
  EXPECT_NEAR(steps[2].length, gap, 1e-11);
}

TEST(GenericNavigator, RaysAlongFacesGetThrough) {
  // Faces and edges of the touching boxes of a lattice, hit exactly and slid along.
  World world;
  world.top = add_volume(world, "world", make_box("world", 4, 4, 4));
  const VolumeId cell = add_volume(world, "cell", make_box("cell", 1, 1, 1));
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k)
        place(world, world.top, cell, {2.0 * i - 3, 2.0 * j - 3, 2.0 * k - 3});
    }
  }
  finish(world);
  const Geometry geometry = geometry_of(world, Force::automatic);
  for (const double tilt : {0.0, 1e-18, -1e-18, 1e-15, -1e-12, 1e-9, -1e-9, 1e-300}) {
    for (const double x : {0.0, 2.0, 1.0, -2.0}) {
      for (const double y : {0.0, 2.0, 0.5}) {
        Vec3 v{tilt, -tilt, 1};
        v = (1 / norm(v)) * v;
        double sum = 0;
        for (const StepRecord& step : trace(geometry, {x, y, -4}, v)) sum += step.length;
        EXPECT_NEAR(sum, 8, 1e-12) << tilt << ' ' << x << ' ' << y;
      }
    }
  }
  const double diagonal = 1 / std::sqrt(3.0);
  double sum = 0;
  for (const StepRecord& step : trace(geometry, {-4, -4, -4}, {diagonal, diagonal, diagonal})) {
    sum += step.length;
  }
  EXPECT_NEAR(sum, 8 * std::sqrt(3.0), 1e-12);
}

}  // namespace
}  // namespace navjit
