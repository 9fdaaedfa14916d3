// Which volumes leave the tree, and which stay because something depends on them.
#include <gtest/gtest.h>

#include "tests/observe/material_trace.hpp"
#include "tests/observe/worlds.hpp"

namespace navjit {
namespace {

using tests::materials_only;
using tests::Shell;
using tests::TwoMaterials;

/// Expects the same tree for a run that looks at materials only.
void expect_same_materials(const ObservedDetector& seen, std::uint64_t rays = 400) {
  std::vector<Ray> all = tests::aimed_rays(seen.original(), rays);
  const common::RayMaker everywhere(*seen.original().model(), {.seed = 3});
  for (std::uint64_t i = 0; i < rays; ++i) all.push_back(everywhere.ray(i));
  const tests::Compared compared = tests::compare(seen, all);
  EXPECT_EQ(compared.different, 0U);
  EXPECT_GT(compared.stretches, rays);
  EXPECT_LT(compared.largest, 1e-9);
}

/// Expects that nothing is dissolved, for the given reason.
void expect_left(const ObservedDetector& seen, const std::string& why) {
  EXPECT_EQ(seen.report().dissolved, 0U);
  ASSERT_FALSE(seen.report().left.empty());
  EXPECT_NE(seen.report().left[0].why.find(why), std::string::npos) << seen.report().left[0].why;
  expect_same_materials(seen);
}

TEST(Dissolve, AShellGivesItsBrickToTheHall) {
  Shell world;
  world.builder.place(world.shell, world.hall, placed_at({10, 0, 0}, {0, 0.4, 0}), 3, "first");
  world.builder.place(world.shell, world.hall, placed_at({-40, 0, 5}, {1, 0, 0}), 4, "second");
  const ObservedDetector seen = world.observed();
  const ObservationReport& report = seen.report();
  EXPECT_EQ(report.invisible, 2U);
  EXPECT_EQ(report.dissolved, 2U);
  EXPECT_EQ(report.touchables_before, 5U);
  EXPECT_EQ(report.touchables_after, 3U);
  EXPECT_EQ(report.placements_after, 2U);
  ASSERT_EQ(report.gone.size(), 1U);
  EXPECT_EQ(report.gone[0].volume, "shell");
  EXPECT_EQ(report.gone[0].mother, "hall");
  EXPECT_EQ(report.gone[0].placements, 2U);
  const auto& daughters = seen.detector().volume(world.hall).daughters;
  ASSERT_EQ(daughters.size(), 2U);
  EXPECT_EQ(daughters[0].volume, world.brick);
  EXPECT_EQ(daughters[0].name, "first/brick_0");
  EXPECT_EQ(daughters[0].copy_number, 7);
  expect_same_materials(seen);
}

TEST(Dissolve, AllObservesAll) {
  Shell world;
  world.builder.place(world.shell, world.hall);
  const ObservedDetector seen = world.observed({});
  EXPECT_EQ(seen.detector().model(), seen.original().model());
  EXPECT_EQ(seen.report().dissolved, 0U);
  EXPECT_TRUE(seen.counts(world.hall, world.shell));
}

TEST(Dissolve, EverythingVacuumIsOneVolume) {
  TwoMaterials world;
  VolumeId inner = world.box("inner0", 1, world.air);
  for (int i = 1; i < 12; ++i) {
    const VolumeId outer = world.box("inner" + std::to_string(i), 1 + i, world.air);
    world.builder.place(inner, outer, placed_at({0.1, 0, 0}));
    inner = outer;
  }
  const ObservedDetector seen(world.builder.build(inner), materials_only);
  EXPECT_EQ(seen.detector().touchables(), 1U);
  expect_same_materials(seen, 100);
}

TEST(Dissolve, WhatIsObservedByNameStays) {
  Shell world;
  world.builder.place(world.shell, world.hall);
  const ObservedDetector seen =
      world.observed({.kind = Observation::Kind::materials, .volumes = {"shell"}});
  EXPECT_EQ(seen.report().invisible, 0U);
  EXPECT_EQ(seen.detector().touchables(), 3U);
  EXPECT_TRUE(seen.counts(world.hall, world.shell));
  expect_same_materials(seen);
  // Nor does a volume disappear into one that is observed: its steps would be taken for those.
  const ObservedDetector around =
      world.observed({.kind = Observation::Kind::materials, .volumes = {"hall"}});
  EXPECT_EQ(around.report().dissolved, 0U);
}

TEST(Dissolve, AnUnknownNameIsAnError) {
  Shell world;
  EXPECT_THROW(world.observed({.kind = Observation::Kind::materials, .volumes = {"shel"}}),
               GeometryError);
}

TEST(Dissolve, OverlappingNeighboursStay) {
  Shell world;
  world.builder.place(world.shell, world.hall);
  world.builder.place(world.brick, world.hall, placed_at({22, 0, 0}, {0, 0, 0.2}));
  expect_left(world.observed(), "overlaps");
}

TEST(Dissolve, OverlapsOfTheSameMaterialDoNotMatter) {
  TwoMaterials world;
  const VolumeId hall = world.box("hall", 100, world.air);
  const VolumeId bubble = world.box("bubble", 10, world.air);
  for (int i = 0; i < 4; ++i) world.builder.place(bubble, hall, placed_at({7.0 * i, 0, 0}));
  const ObservedDetector seen(world.builder.build(hall), materials_only);
  EXPECT_EQ(seen.report().dissolved, 4U);
  expect_same_materials(seen);
}

TEST(Dissolve, WhatSticksOutOfItsMotherStays) {
  Shell world;
  const VolumeId tray = world.box("tray", 15, world.air);
  world.builder.place(world.shell, tray);
  const VolumeId around = world.box("around", 90, world.lead);
  world.builder.place(tray, around);
  const ObservedDetector seen(world.builder.build(around), materials_only);
  expect_left(seen, "out of the mother");
}

TEST(Dissolve, WhatCoversANarrowBoreOfItsMotherStays) {
  for (const double bore : {0.5, 1e-3}) {
    TwoMaterials world;
    const VolumeId hall = world.box("hall", 100, world.lead);
    const VolumeId pipe =
        world.builder.volume("pipe", make_tube("pipe", bore, 60, 60, 0, 2 * M_PI), world.air);
    world.builder.place(world.box("lid", 30, world.air), pipe);
    world.builder.place(pipe, hall);
    expect_left(ObservedDetector(world.builder.build(hall), materials_only), "out of the mother");
  }
}

TEST(Dissolve, WhatItsDaughtersStickOutOfStays) {
  Shell world({18, 0, 0});
  world.builder.place(world.shell, world.hall);
  expect_left(world.observed(), "daughters reach out");
}

TEST(Dissolve, CoincidentFacesAreNoOverlaps) {
  Shell world({15, 0, 0});
  const VolumeId flush = world.box("flush", 20, 20, 5, world.lead);
  world.builder.place(flush, world.shell, placed_at({0, 0, 15}));
  world.builder.place(flush, world.hall, placed_at({0, 0, 25}));
  world.builder.place(world.shell, world.hall);
  world.builder.place(flush, world.hall, placed_at({0, 0, -25}));
  const ObservedDetector seen = world.observed();
  EXPECT_EQ(seen.report().dissolved, 1U);
  expect_same_materials(seen);
}

TEST(Dissolve, ReflectedAndTurnedFramesAreCombined) {
  Shell world;
  const VolumeId tray = world.box("tray", 40, world.air);
  const double reflected[9] = {0, -1, 0, 1, 0, 0, 0, 0, -1};
  world.builder.place(world.shell, tray, make_transformation({5, -8, 0}, reflected));
  world.builder.place(world.brick, tray, make_transformation({-30, 0, 20}, reflected));
  world.builder.place(tray, world.hall, placed_at({20, 10, -3}, {0.2, -1.3, 0.9}));
  const ObservedDetector seen = world.observed();
  EXPECT_EQ(seen.report().dissolved, 2U);
  EXPECT_EQ(seen.detector().touchables(), 3U);
  expect_same_materials(seen);
}

/// Blocks of lead in a row, with spacers of the hall's air between them. A spacer fills the gap, or
/// leaves some of the hall's own air on either side.
ObservedDetector blocks_with_spacers(int blocks, double thickness) {
  TwoMaterials world;
  const VolumeId hall = world.box("hall", 400, world.air);
  const VolumeId block = world.box("block", 50, 50, 2, world.lead);
  const VolumeId spacer = world.box("spacer", 50, 50, thickness / 2, world.air);
  for (int i = 0; i < blocks; ++i) {
    const double z = 8.0 * i - 4.0 * blocks;
    world.builder.place(block, hall, placed_at({0, 0, z}, {0, 0, 0}));
    world.builder.place(spacer, hall, placed_at({0, 0, z + 4}, {0, 0, 0}));
  }
  return ObservedDetector(world.builder.build(hall), materials_only);
}

TEST(Dissolve, SpacersThatTouchWhatTheyAreBetweenAreKeptForSpeed) {
  expect_left(blocks_with_spacers(40, 4), "rays take less time with it");
  const ObservedDetector loose = blocks_with_spacers(40, 1);
  EXPECT_EQ(loose.report().dissolved, 40U);
  expect_same_materials(loose);
}

TEST(Dissolve, EnvelopesThatAreFilledAreKeptForSpeed) {
  for (const bool filled : {true, false}) {
    SCOPED_TRACE(filled);
    TwoMaterials world;
    const VolumeId hall = world.box("hall", 100, world.air);
    const VolumeId envelope = world.box("envelope", 40, world.air);
    const double half = filled ? 20 : 8;
    const VolumeId plate = world.box("plate", filled ? 40 : 20, 40, half, world.lead);
    world.builder.place(plate, envelope, placed_at({0, 0, -20}, {0, 0, 0}));
    world.builder.place(plate, envelope, placed_at({0, 0, 20}, {0, 0, 0}));
    world.builder.place(envelope, hall);
    const ObservedDetector seen(world.builder.build(hall), materials_only);
    EXPECT_EQ(seen.report().dissolved, filled ? 0U : 1U);
    expect_same_materials(seen);
  }
}

TEST(Dissolve, TubesAreProvedByTheirRadii) {
  TwoMaterials world;
  const auto tube = [&](const char* name, double rmin, double rmax, double hz,
                        DetectorBuilder::MaterialId material) {
    return world.builder.volume(name, make_tube(name, rmin, rmax, hz, 0, 7), material);
  };
  const VolumeId hall = tube("hall", 0, 100, 100, world.air);
  const VolumeId pipe = tube("pipe", 30, 50, 80, world.air);
  const VolumeId ring = tube("ring", 40, 48, 80, world.lead);
  const VolumeId core = tube("core", 0, 28, 80, world.lead);
  world.builder.place(ring, pipe);
  world.builder.place(core, hall);
  world.builder.place(pipe, hall);
  const ObservedDetector seen(world.builder.build(hall), materials_only);
  EXPECT_EQ(seen.report().dissolved, 1U);
  EXPECT_EQ(seen.report().sampled, 0U);
  expect_same_materials(seen);
}

TEST(Dissolve, VolumesOfManyDaughtersAreKeptAsPlacesToSearch) {
  TwoMaterials world;
  const VolumeId hall = world.box("hall", 100, world.air);
  const VolumeId rack = world.box("rack", 50, 10, 10, world.air);
  const VolumeId brick = world.box("brick", 2, world.lead);
  for (int i = 0; i < 10; ++i) world.builder.place(brick, rack, placed_at({-45.0 + 10 * i, 0, 0}));
  world.builder.place(rack, hall, placed_at({0, 20, 0}));
  // All that there is in the mother: it has the same to search then.
  EXPECT_EQ(ObservedDetector(world.builder.build(hall), materials_only).report().dissolved, 1U);
  world.builder.place(brick, hall, placed_at({0, -20, 0}));
  const ObservedDetector seen(world.builder.build(hall), materials_only);
  EXPECT_EQ(seen.report().dissolved, 0U);
  EXPECT_EQ(seen.report().left.at(0).placements, 1U);
  expect_same_materials(seen);
  EXPECT_FALSE(seen.counts(hall, rack));
}

TEST(Dissolve, NothingIsCopied) {
  TwoMaterials world;
  const VolumeId hall = world.box("hall", 100, world.air);
  const VolumeId pair = world.box("pair", 2, world.air);
  const VolumeId brick = world.box("brick", 0.5, world.lead);
  for (const double x : {-1.2, 0.0, 1.2}) world.builder.place(brick, pair, placed_at({x, 0, 0}));
  world.builder.place(brick, hall, placed_at({0, 50, 0}));
  world.builder.place(pair, hall, placed_at({-50, 0, 0}));
  // Placed once, its bricks are the hall's; placed twice, they would be there twice.
  const ObservedDetector once(world.builder.build(hall), materials_only);
  EXPECT_EQ(once.report().dissolved, 1U);
  EXPECT_EQ(once.report().placements_after, 4U);
  world.builder.place(pair, hall, placed_at({50, 0, 0}));
  const ObservedDetector twice(world.builder.build(hall), materials_only);
  EXPECT_EQ(twice.report().placements_after, twice.report().placements_before);
  expect_left(twice, "more than once");
}

TEST(Dissolve, StepsPassWhatIsLeft) {
  // Bricks side by side: no daughter is of its mother's material, and still nothing changes between
  // them.
  TwoMaterials world;
  const VolumeId hall = world.box("hall", 100, world.air);
  const VolumeId brick = world.box("brick", 5, world.lead);
  for (int i = 0; i < 6; ++i) world.builder.place(brick, hall, placed_at({-25.0 + 10 * i, 0, 0}));
  const ObservedDetector seen(world.builder.build(hall), materials_only);
  Runtime runtime(seen.detector(), {.jit = JitMode::off});
  Navigator navigator = runtime.navigator();
  const Vec3 along{1, 0, 0};
  const State start = navigator.locate({-99, 1, 1}, along);
  const Step first = seen.step(navigator, start, {-99, 1, 1}, along);
  EXPECT_DOUBLE_EQ(first.length, 69);
  const Step second = seen.step(navigator, first.next, {-30, 1, 1}, along);
  EXPECT_DOUBLE_EQ(second.length, 60);
  EXPECT_TRUE(second.boundary);
  EXPECT_EQ(second.next.volume(), hall);
  const Step limited = seen.step(navigator, first.next, {-30, 1, 1}, along, 25);
  EXPECT_DOUBLE_EQ(limited.length, 25);
  EXPECT_FALSE(limited.boundary);
  EXPECT_EQ(seen.detector().copy_number(limited.next), 0);
  EXPECT_EQ(seen.detector().path_of(limited.next), "hall/brick_2");
}

}  // namespace
}  // namespace navjit
