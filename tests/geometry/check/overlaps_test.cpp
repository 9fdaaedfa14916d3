#include "geometry/check/overlaps.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "geometry/check/surface.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

using tests::add_volume;
using tests::place;

std::vector<Overlap> overlaps(World world, OverlapOptions options = {}) {
  finish(world);
  return find_overlaps(Geometry(std::make_shared<const World>(std::move(world))), options);
}

TEST(SurfacePoints, AreOnTheSurfaceAndAllOverIt) {
  const Solid box = make_box("b", 1, 2, 3);
  const Solid tube = make_tube("t", 1, 2, 3, 0.5, 4);
  const Solid hollow = make_subtraction("s", box, make_box("c", 0.5, 0.5, 0.5));
  for (const Solid& solid : {box, tube, hollow}) {
    const auto points = surface_points(solid, 2000, 1e-11, 1);
    ASSERT_EQ(points.size(), 2000U);
    for (const Vec3& p : points) EXPECT_EQ(inside(solid.any(), p, 1e-9), Side::surface);
  }
  // The faces of the box by area: 24, 12 and 8 of 44 half areas.
  int on_x = 0;
  for (const Vec3& p : surface_points(box, 20000, 1e-11, 2)) {
    on_x += std::abs(std::abs(p.x) - 1) < 1e-9 ? 1 : 0;
  }
  EXPECT_NEAR(on_x / 20000.0, 24.0 / 44.0, 0.02);
}

TEST(Overlaps, AreNotFoundWhereThereAreNone) {
  const auto mixed = overlaps(tests::mixed_world());  // touching faces among it
  for (const Overlap& o : mixed) {
    ADD_FAILURE() << o.volume << ": " << o.first << " and " << o.second << ", " << o.depth;
  }
  EXPECT_TRUE(overlaps(tests::random_world(1, 3), {.resolution = 200}).empty());
}

TEST(Overlaps, ArePairsWithAPointAndADepth) {
  World world;
  world.top = add_volume(world, "world", make_box("w", 10, 10, 10));
  const VolumeId a = add_volume(world, "a", make_box("a", 1, 1, 1));
  place(world, world.top, a, {0, 0, 0});
  place(world, world.top, a, {1.9, 0, 0});  // 0.1 into the first
  place(world, world.top, a, {0, 9.5, 0});  // 0.5 out of the world
  place(world, world.top, a, {-5, 0, 0});   // alone
  const auto found = overlaps(std::move(world));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].first, 0U);
  EXPECT_EQ(found[0].second, 1U);
  EXPECT_GT(found[0].depth, 0.05);
  EXPECT_LE(found[0].depth, 0.1 + 1e-12);
  EXPECT_NEAR(found[0].point.x, 0.95, 0.06);
  EXPECT_EQ(found[1].first, 2U);
  EXPECT_EQ(found[1].second, Overlap::mother);
  EXPECT_NEAR(found[1].depth, 0.5, 0.05);
}

TEST(Overlaps, AVolumeWhollyInAnotherIsFound) {
  World world;
  world.top = add_volume(world, "world", make_box("w", 10, 10, 10));
  const VolumeId large = add_volume(world, "large", make_box("l", 5, 5, 5));
  const VolumeId small = add_volume(world, "small", make_box("s", 1, 1, 1));
  place(world, world.top, large, {0, 0, 0});
  place(world, world.top, small, {2, 0, 0});
  const auto found = overlaps(std::move(world));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_GT(found[0].depth, 1.9);
}

TEST(Overlaps, ShallowerThanTheToleranceAreNotTold) {
  World world;
  world.top = add_volume(world, "world", make_box("w", 10, 10, 10));
  const VolumeId a = add_volume(world, "a", make_box("a", 1, 1, 1));
  place(world, world.top, a, {0, 0, 0});
  place(world, world.top, a, {2 - 1e-4, 0, 0});
  EXPECT_EQ(overlaps(world, {.tolerance = 1e-3}).size(), 0U);
  EXPECT_EQ(overlaps(world, {.tolerance = 1e-6}).size(), 1U);
}

}  // namespace
}  // namespace navjit
