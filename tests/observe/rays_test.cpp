// Materials along rays are those of the whole detector, for shipped, published and random ones.
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

/// Changes of material may move by the rounding of composed frames, which is larger for rays that
/// graze a face (docs/observation.md).
constexpr double most_moved = 1e-6;  // mm

TEST(MaterialsAlongRays, AreThoseOfTheShippedDetectors) {
  for (const std::string& file : gdml_files({NAVJIT_DETECTORS_DIR})) {
    const ObservedDetector seen(read_gdml(file), tests::materials_only);
    for (const JitMode jit : {JitMode::off, JitMode::wait}) {
      const auto compared = tests::compare(seen, tests::aimed_rays(seen.original(), 500), jit);
      EXPECT_EQ(compared.different, 0U) << file;
      EXPECT_LT(compared.largest, most_moved) << file;
    }
  }
}

TEST(MaterialsAlongRays, AreThoseOfPublishedDetectors) {
  const fs::path folder = NAVJIT_DATA_DIR;
  if (!fs::is_directory(folder)) GTEST_SKIP() << folder << " is not here";
  std::uint64_t dissolved = 0;
  double largest = 0;
  for (const std::string& file : gdml_files({folder.string()})) {
    try {
      const ObservedDetector seen(read_gdml(file), tests::materials_only);
      const auto compared = tests::compare(seen, tests::aimed_rays(seen.original(), 100, 5));
      EXPECT_EQ(compared.different, 0U) << file;
      EXPECT_LT(compared.largest, most_moved) << file;
      largest = std::max(largest, compared.largest);
      dissolved += seen.report().dissolved;
    } catch (const GdmlError&) {  // some are of solids that cannot be
    }
  }
  EXPECT_GT(dissolved, 5000U);
  RecordProperty("largest_mm", std::to_string(largest));
}

/// A tree of boxes and tubes, most of them of the mother's material; some stick out or overlap.
Detector random_tree(std::uint64_t seed, bool clean) {
  std::mt19937_64 random(seed);
  const auto any = [&](double low, double high) { return tests::uniform(random, low, high); };
  tests::TwoMaterials world;
  const auto material = [&] { return any(0, 1) < 0.65 ? world.air : world.lead; };
  std::vector<VolumeId> level;
  for (int i = 0; i < 6; ++i) level.push_back(world.box("leaf" + std::to_string(i), 1, material()));
  double half = 1;
  for (int depth = 1; depth < 4; ++depth) {
    // Eight cells, each with room for a sphere about what is placed in it at any angle.
    const double room = 1.75 * half;
    half = 2 * room;
    std::vector<VolumeId> next;
    for (int i = 0; i < 4; ++i) {
      const std::string name = "v" + std::to_string(depth) + "_" + std::to_string(i);
      const VolumeId volume =
          i % 2 == 0
              ? world.box(name, half, material())
              : world.builder.volume(name, make_tube(name, 0, 1.5 * half, half, 0, 7), material());
      for (int cell = 0; cell < 8; ++cell) {
        if (any(0, 1) < 0.6) continue;
        const double shift = clean ? room : any(0.7, 1.3) * room;
        world.builder.place(
            level[random() % level.size()], volume,
            placed_at({(cell & 1) != 0 ? shift : -shift, (cell & 2) != 0 ? shift : -shift,
                       (cell & 4) != 0 ? shift : -shift},
                      {any(-3, 3), any(-3, 3), any(-3, 3)}));
      }
      next.push_back(volume);
    }
    level = next;
    half *= 1.5;
  }
  return world.builder.build(level[0]);
}

TEST(MaterialsAlongRays, AreThoseOfRandomTrees) {
  std::uint64_t dissolved = 0, left = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const bool clean = seed % 3 != 0;
    const ObservedDetector seen(random_tree(seed, clean), tests::materials_only);
    std::vector<Ray> rays;
    const common::RayMaker maker(*seen.original().model(), {.seed = seed});
    for (std::uint64_t i = 0; i < 400; ++i) rays.push_back(maker.ray(i));
    const auto compared = tests::compare(seen, rays);
    EXPECT_EQ(compared.different, 0U) << "seed " << seed;
    EXPECT_LT(compared.largest, most_moved) << "seed " << seed;
    dissolved += seen.report().dissolved;
    for (const auto& entry : seen.report().left) left += entry.placements;
  }
  EXPECT_GT(dissolved, 1000U);
  EXPECT_GT(left, 100U);
}

}  // namespace
}  // namespace navjit
