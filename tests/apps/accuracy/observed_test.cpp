// Observations against every boundary: what rays go through, where they enter observed volumes.
#include "apps/accuracy/observed.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/accuracy/observed_report.hpp"
#include "navjit/builder.hpp"
#include "tests/observe/material_trace.hpp"

namespace navjit::accuracy {
namespace {

/// A hall with eight blocks, each of 20 plates, lead and plastic in turn. The blocks are observed.
Detector blocks() {
  DetectorBuilder builder;
  const auto element = [&](const char* name, double z, double a) {
    return builder.element({.name = name, .z = z, .a = a});
  };
  const auto of = [&](const char* name, double density, auto part) {
    return builder.material({.name = name, .density = density, .elements = {{part, 1}}});
  };
  const auto air = of("air", 0.0012, element("N", 7, 14.007));
  const auto lead = of("lead", 11.35, element("Pb", 82, 207.2));
  const auto plastic = of("plastic", 1.05, element("C", 6, 12.011));
  const VolumeId hall = builder.volume("hall", make_box("hall", 500, 500, 500), air);
  const VolumeId block = builder.volume("block", make_box("block", 50, 50, 50), plastic);
  const VolumeId plate = builder.volume("plate", make_box("plate", 50, 50, 1), lead);
  builder.add_auxiliary(block, {"SensDet", "blocks"});
  for (int i = 0; i < 20; ++i) builder.place(plate, block, placed_at({0, 0, -47.5 + 5 * i}));
  for (int i = 0; i < 8; ++i) {
    builder.place(block, hall,
                  placed_at({(i & 1) != 0 ? 60.0 : -60, (i & 2) != 0 ? 60.0 : -60,
                             (i & 4) != 0 ? 60.0 : -60}));
  }
  return builder.build(hall);
}

std::vector<ObservedFigures> compared() {
  const Detector detector = blocks();
  return compare_observations(detector,
                              {parse_observation("materials"), parse_observation("mixtures:10%")},
                              tests::aimed_rays(detector, 2000), 1, std::nullopt);
}

TEST(ObservedFigures, SayWhatMixturesChange) {
  const auto figures = compared();
  ASSERT_EQ(figures.size(), 3U);
  const ObservedFigures &all = figures[0], &materials = figures[1], &mixtures = figures[2];
  EXPECT_EQ(all.mean, 0);
  EXPECT_EQ(materials.steps_per_ray, all.steps_per_ray);
  EXPECT_LT(materials.largest, 1e-9);
  EXPECT_LT(mixtures.steps_per_ray, 0.5 * all.steps_per_ray);
  EXPECT_GT(mixtures.mean, 0.01 * all.whole);
  EXPECT_LE(mixtures.mean, 0.11 * all.whole);
  EXPECT_LE(mixtures.mean, mixtures.most_of_1000);
  EXPECT_LE(mixtures.most_of_1000, mixtures.largest);
  EXPECT_LE(mixtures.largest, mixtures.bound);
  EXPECT_FALSE(any_beyond(figures));
  for (const ObservedFigures& f : figures) {
    EXPECT_GT(f.ns_per_ray, 0);
    EXPECT_GT(f.data_ns_per_ray, 0);
  }
}

TEST(ObservedFigures, TellDirectionsApart) {
  const auto figures = compared();
  for (const ObservedFigures& f : figures) {
    std::size_t rays = 0;
    double sum = 0, largest = 0;
    for (const DirectionFigures& d : f.directions) {
      rays += d.rays;
      sum += d.mean * static_cast<double>(d.rays);
      largest = std::max(largest, d.largest);
    }
    EXPECT_EQ(rays, 2000U);
    EXPECT_NEAR(sum / 2000, f.mean, 1e-9 * (1 + f.mean));
    EXPECT_EQ(largest, f.largest);
  }
  // Rays along the plates see most of a difference.
  const auto& d = figures[2].directions;
  EXPECT_GT(d[4].mean + d[5].mean, 2 * (d[0].mean + d[9].mean));
}

TEST(ObservedFigures, PathsInAMixtureAreThoseOfItsParts) {
  const auto figures = compared();
  const ObservedFigures& f = figures[2];
  ASSERT_EQ(f.materials.size(), 3U);
  for (const MaterialFigures& m : f.materials) {
    // In the mean over isotropic rays the paths stay.
    EXPECT_NEAR(m.after, m.before, 0.1 * m.before) << m.material;
  }
  EXPECT_NEAR(f.materials[0].change, 0, 1e-9);  // of air: none of it was mixed
  EXPECT_GT(f.materials[1].change, 1);
}

TEST(ObservedFigures, EntriesIntoObservedVolumesStay) {
  const auto figures = compared();
  EXPECT_EQ(figures[0].entries.before, 0U);  // to `all` nothing is special
  for (const std::size_t i : {1, 2}) {
    const ObservedFigures& f = figures[i];
    EXPECT_GT(f.entries.before, 1000U);
    EXPECT_EQ(f.entries.after, f.entries.before);
    EXPECT_EQ(f.entries.rays_that_differ, 0U);
    EXPECT_LT(f.entries.largest, 1e-9);
  }
}

TEST(ObservedFigures, AreWritten) {
  const auto figures = compared();
  const auto json = to_json(figures);
  ASSERT_EQ(json.size(), 3U);
  EXPECT_EQ(json[2]["observe"], "mixtures:10%");
  EXPECT_EQ(json[2]["directions"].size(), 10U);
  EXPECT_EQ(json[2]["entries"]["rays_that_differ"], 0);
  EXPECT_FALSE(json[2].contains("vecgeom_ns_per_ray"));
}

}  // namespace
}  // namespace navjit::accuracy
