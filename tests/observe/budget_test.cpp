// No ray changes by more radiation lengths than the budget allows.
#include "observe/budget.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "navjit/gdml.hpp"
#include "tests/campaign/files.hpp"
#include "tests/observe/material_trace.hpp"
#include "tests/observe/worlds.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

namespace fs = std::filesystem;

Observation within(double budget) { return {.kind = Observation::Kind::budget, .budget = budget}; }

/// The largest change of any of the rays, which must be within what the report promises.
double largest_change(const ObservedDetector& seen, const std::vector<Ray>& rays) {
  Runtime whole(seen.original(), {.jit = JitMode::off}),
      less(seen.detector(), {.jit = JitMode::off});
  Navigator every = whole.navigator(), left = less.navigator();
  ObservedNavigator observed(seen, left);
  double largest = 0;
  for (const Ray& ray : rays) {
    const double before = tests::radiation_lengths(every, seen.original(), ray);
    const double after = tests::radiation_lengths(observed, seen.original(), ray);
    // Sums of many steps are rounded, and changes of material move a little (docs/observation.md).
    largest = std::max(largest, std::abs(after - before) - 1e-9 * (1 + before));
  }
  return largest;
}

/// Vacuum, gases and solids; each has boxes of the others in it.
struct Mixed : tests::TwoMaterials {
  DetectorBuilder::MaterialId of(const char* name, double radiation_length) {
    return builder.material({.name = name, .density = 1, .radiation_length = radiation_length});
  }
  DetectorBuilder::MaterialId vacuum = of("vacuum", 1e28), gas = of("gas", 4e5),
                              foil = of("foil", 300), plate = of("plate", 290),
                              tungsten = of("tungsten", 3.5);
  VolumeId hall = box("hall", 500, gas);
};

TEST(Budget, MaterialsThatAreNearlyTheSameAreOne) {
  Mixed world;
  const VolumeId pipe = world.box("pipe", 100, world.vacuum);
  const VolumeId slab = world.box("slab", 50, world.plate);
  const VolumeId sheet = world.box("sheet", 20, world.foil);
  world.builder.place(sheet, slab);
  world.builder.place(slab, pipe);
  world.builder.place(pipe, world.hall);
  const Detector detector = world.builder.build(world.hall);
  const double path = longest_path(*detector.model());
  EXPECT_NEAR(path, 1000 * std::sqrt(3.0), 1e-9);
  const MaterialGroups narrow = group_materials(*detector.model(), 1e-9);
  EXPECT_NE(narrow.group_of[world.vacuum], narrow.group_of[world.gas]);
  EXPECT_EQ(narrow.bound, 0);
  const MaterialGroups wide = group_materials(*detector.model(), 0.005);
  EXPECT_EQ(wide.group_of[world.vacuum], wide.group_of[world.gas]);
  EXPECT_NE(wide.group_of[world.foil], wide.group_of[world.plate]);
  EXPECT_NEAR(wide.bound, path / 4e5, 1e-9);
  // Materials of which nothing is known are alone.
  EXPECT_NE(wide.group_of[world.air], wide.group_of[world.lead]);

  const ObservedDetector seen(detector, within(0.01));
  EXPECT_EQ(seen.report().dissolved, 1U);
  EXPECT_LE(seen.report().bound, 0.01);
  EXPECT_FALSE(seen.counts(world.hall, pipe));
  const double change = largest_change(seen, tests::aimed_rays(detector, 2000));
  EXPECT_GT(change, 1e-5);
  EXPECT_LE(change, seen.report().bound);
}

TEST(Budget, SmallVolumesGoFirst) {
  Mixed world;
  const VolumeId wire =
      world.builder.volume("wire", make_tube("wire", 0, 1e-3, 1, 0, 7), world.foil);
  const VolumeId ball = world.builder.volume("ball", make_orb("ball", 5), world.tungsten);
  for (int i = 0; i < 5; ++i) world.builder.place(wire, world.hall, placed_at({10.0 * i, 0, 0}));
  world.builder.place(ball, world.hall, placed_at({0, 50, 0}));
  const Detector detector = world.builder.build(world.hall);
  EXPECT_EQ(ObservedDetector(detector, within(0.001)).report().dissolved, 0U);
  const ObservedDetector seen(detector, within(0.1));
  EXPECT_EQ(seen.report().dissolved, 5U);
  EXPECT_NEAR(seen.report().bound, 5 * 2 * std::hypot(1e-3, 1.0) * (1 / 300.0 - 1 / 4e5), 1e-12);
  EXPECT_LE(largest_change(seen, tests::aimed_rays(detector, 2000)), seen.report().bound);
  const ObservedDetector more(detector, within(10));
  EXPECT_EQ(more.report().dissolved, 6U);
  // What is observed stays, however small it is.
  Observation marked = within(10);
  marked.volumes = {"wire"};
  EXPECT_EQ(ObservedDetector(detector, marked).report().dissolved, 1U);
}

TEST(Budget, OfMassTakesDensities) {
  Mixed world;
  const VolumeId ball = world.builder.volume("ball", make_orb("ball", 5), world.tungsten);
  const VolumeId brick = world.box("brick", 5, world.lead);
  world.builder.place(ball, world.hall, placed_at({0, 50, 0}));
  world.builder.place(brick, world.hall, placed_at({0, -50, 0}));
  const Detector detector = world.builder.build(world.hall);
  // All materials of Mixed have one density: they are one to a budget of mass.
  const ObservedDetector seen(detector, parse_observation("budget:0.001g/cm2"));
  EXPECT_EQ(seen.report().dissolved, 1U);
  EXPECT_EQ(seen.report().bound, 0);
  const ObservedDetector more(detector, parse_observation("budget:20g/cm2"));
  EXPECT_EQ(more.report().dissolved, 2U);
  EXPECT_NEAR(more.report().bound, std::sqrt(300.0) * 1.035, 1e-9);
}

TEST(Budget, ThatIsRelativeIsHeldPointByPoint) {
  Mixed world;
  const VolumeId slab = world.box("slab", 50, world.plate);
  const VolumeId sheet = world.box("sheet", 20, world.foil);
  world.builder.place(sheet, slab);
  world.builder.place(slab, world.hall);
  const Detector detector = world.builder.build(world.hall);
  EXPECT_EQ(ObservedDetector(detector, parse_observation("budget:3%")).report().dissolved, 0U);
  const ObservedDetector seen(detector, parse_observation("budget:4%"));
  EXPECT_EQ(seen.report().dissolved, 1U);
  EXPECT_NEAR(seen.report().bound, 300.0 / 290 - 1, 1e-12);
  Runtime whole(detector, {.jit = JitMode::off}), less(seen.detector(), {.jit = JitMode::off});
  Navigator every = whole.navigator(), left = less.navigator();
  ObservedNavigator observed(seen, left);
  for (const Ray& ray : tests::aimed_rays(detector, 500)) {
    const double before = tests::radiation_lengths(every, detector, ray);
    EXPECT_LE(std::abs(tests::radiation_lengths(observed, seen.detector(), ray) - before),
              seen.report().bound * before * (1 + 1e-9));
  }
}

TEST(Budget, IsKeptInNestedVolumes) {
  Mixed world;
  std::mt19937_64 random(9);
  const auto any = [&](double low, double high) { return tests::uniform(random, low, high); };
  const DetectorBuilder::MaterialId all[] = {world.vacuum, world.gas, world.foil, world.plate,
                                             world.tungsten};
  for (int i = 0; i < 400; ++i) {
    const std::string name = std::to_string(i);
    VolumeId inner = world.box("v" + name, std::pow(10, any(-3, 0.8)), all[random() % 5]);
    double half = 7;
    for (int level = 0; level < 2; ++level) {
      const VolumeId outer =
          world.box("v" + name + "_" + std::to_string(level), half, all[random() % 5]);
      world.builder.place(inner, outer);
      inner = outer;
      half += 3;
    }
    const double cell = 1000.0 / 8;
    world.builder.place(inner, world.hall,
                        placed_at({-500 + cell * (0.5 + i % 8), -500 + cell * (0.5 + i / 8 % 8),
                                   -500 + cell * (0.5 + i / 64)}));
  }
  const Detector detector = world.builder.build(world.hall);
  const std::vector<Ray> rays = tests::aimed_rays(detector, 3000);
  std::uint64_t last = 0;
  for (const double budget : {1e-6, 1e-4, 1e-2, 1.0, 100.0}) {
    const ObservedDetector seen(detector, within(budget));
    EXPECT_LE(seen.report().bound, budget);
    EXPECT_LE(largest_change(seen, rays), seen.report().bound) << budget;
    EXPECT_GE(seen.report().dissolved, last) << budget;
    last = seen.report().dissolved;
  }
  EXPECT_GT(last, 500U);
}

TEST(Budget, IsKeptInDetectors) {
  std::vector<std::string> given{NAVJIT_DETECTORS_DIR};
  if (fs::is_directory(NAVJIT_DATA_DIR)) given.emplace_back(NAVJIT_DATA_DIR);
  for (const std::string& file : gdml_files(given)) {
    SCOPED_TRACE(file);
    try {
      const Detector detector = read_gdml(file);
      const std::vector<Ray> rays = tests::aimed_rays(detector, 50, 11);
      for (const double budget : {1e-4, 0.1}) {
        const ObservedDetector seen(detector, within(budget));
        EXPECT_LE(seen.report().bound, budget);
        EXPECT_LE(largest_change(seen, rays), seen.report().bound) << budget;
      }
    } catch (const GdmlError&) {  // some are of solids that cannot be
    }
  }
}

}  // namespace
}  // namespace navjit
