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
  return check_overlaps(Geometry(std::make_shared<const World>(std::move(world))), options)
      .overlaps;
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

/// The overlaps in a world of 20 mm with the two solids.
std::vector<Overlap> of_two(const Solid& a, const Solid& b, Vec3 at = {0, 0, 0},
                            Vec3 angles = {0, 0, 0}) {
  World world;
  world.top = add_volume(world, "world", make_box("w", 10, 10, 10));
  place(world, world.top, add_volume(world, "a", a), {0, 0, 0});
  place(world, world.top, add_volume(world, "b", b), at, angles);
  return overlaps(std::move(world));
}

TEST(Overlaps, VolumesThatCoincideAreFound) {
  const Solid box = make_box("b", 1, 2, 3), tube = make_tube("t", 1, 2, 3, 0, 7);
  for (const Solid& solid : {box, tube, make_orb("o", 2), make_trd("r", 1, 2, 1, 2, 3),
                             make_tube("s", 1, 2, 3, 0.5, 1)}) {
    const auto found = of_two(solid, solid);
    ASSERT_EQ(found.size(), 1U) << solid.name;
    EXPECT_EQ(found[0].first, 0U);
    EXPECT_EQ(found[0].second, 1U);
    EXPECT_GT(found[0].depth, 0.4) << solid.name;
  }
  // By another solid of the same shape, and by turns that are symmetries.
  EXPECT_EQ(of_two(tube, make_subtraction("t", make_tube("t", 0, 2, 3, 0, 7),
                                          make_tube("h", 0, 1, 4, 0, 7)))
                .size(),
            1U);
  EXPECT_EQ(of_two(tube, tube, {0, 0, 0}, {0, 0, 1.234}).size(), 1U);
  EXPECT_EQ(of_two(tube, tube, {0, 0, 0}, {M_PI, 0, 0}).size(), 1U);
  EXPECT_EQ(of_two(box, box, {0, 0, 0}, {0, 0, M_PI}).size(), 1U);
  EXPECT_EQ(of_two(box, make_box("turned", 2, 1, 3), {0, 0, 0}, {0, 0, M_PI / 2}).size(), 1U);
  // A half of it, flush on five sides.
  EXPECT_EQ(of_two(box, make_box("half", 1, 2, 1.5), {0, 0, 1.5}).size(), 1U);
}

TEST(Overlaps, WhatFillsAHoleOrTouchesIsNone) {
  const Solid pipe = make_tube("p", 1, 2, 3, 0, 7);
  EXPECT_TRUE(of_two(pipe, make_tube("core", 0, 1, 3, 0, 7)).empty());
  EXPECT_TRUE(of_two(pipe, pipe, {0, 0, 6}).empty());
  EXPECT_TRUE(of_two(make_box("a", 1, 1, 1), make_box("b", 1, 1, 1), {2, 2, 0}).empty());
  const Solid quarter = make_tube("q", 0, 3, 3, 0, M_PI / 2);
  EXPECT_TRUE(of_two(quarter, quarter, {0, 0, 0}, {0, 0, M_PI / 2}).empty());
}

TEST(Overlaps, OneThatHoldsItsSiblingIsFound) {
  const auto found = of_two(make_box("small", 1, 1, 1), make_box("large", 4, 4, 4));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_GE(found[0].depth, 3);
}

TEST(Overlaps, ADaughterThatFillsItsMotherIsNone) {
  for (const Solid& solid : {make_box("b", 10, 10, 10), make_tube("t", 1, 2, 3, 0, 7)}) {
    World world;
    world.top = add_volume(world, "world", solid);
    place(world, world.top, add_volume(world, "same", solid), {0, 0, 0});
    EXPECT_TRUE(overlaps(std::move(world)).empty()) << solid.name;
  }
}

TEST(Overlaps, ThinOnesThatCrossAreFound) {
  const Solid plate = make_box("plate", 8, 8, 1e-4), wire = make_tube("wire", 0, 1e-4, 8, 0, 7);
  EXPECT_EQ(of_two(plate, plate, {0, 0, 0}, {M_PI / 2, 0, 0}).size(), 1U);
  EXPECT_EQ(of_two(plate, plate, {0, 0, 0}, {0.7, 0.4, 0.2}).size(), 1U);
  EXPECT_EQ(of_two(plate, plate, {0.3, 0.2, 0}, {0, 0, 0.1}).size(), 1U);
  EXPECT_EQ(of_two(plate, wire).size(), 1U);
  EXPECT_EQ(of_two(wire, wire, {0, 0, 0}, {0.8, 0.3, 0}).size(), 1U);
  EXPECT_TRUE(of_two(plate, plate, {0, 0, 2e-4}).empty());
  EXPECT_TRUE(of_two(wire, wire, {0, 2.1e-4, 0}, {0, 0.8, 0}).empty());
}

TEST(Overlaps, DaughtersFarLargerThanTheirMotherAreFound) {
  const Solid far_larger[] = {make_box("box", 1e8, 1e8, 1e8),
                              make_orb("orb", 1e8),
                              make_box("beam", 1e8, 1, 1),
                              make_tube("wire", 0, 1, 1e8, 0, 7),
                              make_tube("hoop", 1e8, 1e8 + 10, 1, 0, 7),
                              make_box("foil", 1e8, 1e8, 1e-5)};
  for (const Solid& solid : far_larger) {
    World world;
    world.top = add_volume(world, "world", make_box("w", 500, 500, 500));
    place(world, world.top, add_volume(world, "d", solid), {0, 0, 0});
    const auto found = overlaps(std::move(world));
    ASSERT_EQ(found.size(), 1U) << solid.name;
    EXPECT_EQ(found[0].second, Overlap::mother) << solid.name;
    EXPECT_GT(found[0].depth, 1e6) << solid.name;
  }
}

TEST(Overlaps, WhatFillsAHoleOfItsMotherSticksOut) {
  World world;
  world.top = add_volume(world, "world", make_tube("pipe", 1, 2, 3, 0, 7));
  place(world, world.top, add_volume(world, "core", make_tube("core", 0, 1, 3, 0, 7)), {0, 0, 0});
  const auto found = overlaps(std::move(world));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].second, Overlap::mother);
  EXPECT_GT(found[0].depth, 0.9);
}

TEST(Overlaps, WhatCoversANarrowBoreOfItsMotherSticksOut) {
  for (const double bore : {0.5, 1e-3}) {
    World world;
    world.top = add_volume(world, "world", make_tube("pipe", bore, 500, 500, 0, 7));
    place(world, world.top, add_volume(world, "lid", make_box("lid", 100, 100, 100)), {0, 0, 0});
    const auto found = overlaps(std::move(world));
    ASSERT_EQ(found.size(), 1U) << bore;
    EXPECT_EQ(found[0].second, Overlap::mother);
    EXPECT_GT(found[0].depth, 50);
  }
}

TEST(Overlaps, WhatCoversAHoleThatIsNowhereNearTheAxesIsFound) {
  SolidFrame aside;
  aside.translation[0] = 30;
  aside.translation[1] = 20;
  const Solid drill = make_placed("aside", make_tube("drill", 0, 1, 600, 0, 7), aside);
  World world;
  world.top = add_volume(world, "world",
                         make_subtraction("bored", make_box("block", 500, 500, 500), drill));
  place(world, world.top, add_volume(world, "lid", make_box("lid", 100, 100, 100)), {0, 0, 0});
  const auto found = overlaps(std::move(world));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].second, Overlap::mother);
}

TEST(Overlaps, CornersThatStickOutAreFound) {
  World world;
  world.top = add_volume(world, "world", make_tube("pipe", 0, 100, 500, 0, 7));
  // Its corners are 100.0005 mm from the axis.
  place(world, world.top, add_volume(world, "bar", make_box("bar", 70.711, 70.711, 100)),
        {0, 0, 0});
  EXPECT_EQ(overlaps(std::move(world)).size(), 1U);
}

TEST(Overlaps, EndsOfWiresThatStickOutAreFound) {
  for (const double by : {1e-5, 1e-2}) {
    World world;
    world.top = add_volume(world, "world", make_box("w", 10, 10, 10));
    place(world, world.top, add_volume(world, "wire", make_tube("wire", 0, 1e-3, 8, 0, 7)),
          {0, 0, 2 + by});
    EXPECT_EQ(overlaps(std::move(world)).size(), 1U);
  }
}

TEST(Overlaps, WhatNoPointIsFoundOfIsTold) {
  SolidFrame diagonal;
  rotation_from_angles(0.7, 0.6, 0, diagonal.rotation);
  const Solid needle = make_placed("needle", make_tube("straight", 0, 1e-7, 8, 0, 7), diagonal);
  World world;
  world.top = add_volume(world, "world", make_box("w", 10, 10, 10));
  place(world, world.top, add_volume(world, "needle", needle), {0, 0, 0});
  finish(world);
  const OverlapReport report =
      check_overlaps(Geometry(std::make_shared<const World>(std::move(world))));
  ASSERT_EQ(report.not_sampled.size(), 1U);
  EXPECT_EQ(report.not_sampled[0].second, 0U);
}

}  // namespace
}  // namespace navjit
