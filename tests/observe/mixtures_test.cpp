// Homogenised volumes: mass and elements are kept, observed volumes stay, and rays change by no
// more than is asked for, in the mean.
#include "observe/mixtures.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "navjit/gdml.hpp"
#include "observe/budget.hpp"
#include "tests/campaign/files.hpp"
#include "tests/observe/material_trace.hpp"
#include "tests/observe/worlds.hpp"
#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

namespace fs = std::filesystem;

Observation mixtures(double budget, Observation::Unit unit = Observation::Unit::relative) {
  return {.kind = Observation::Kind::mixtures, .budget = budget, .unit = unit};
}

/// g of each element in the world, and the total mm3, from volumes in closed form.
std::vector<double> masses(const Detector& detector) {
  const World& world = *detector.model();
  std::vector<double> sums(world.elements.size());
  const std::vector<double> counts = touchables_of(world);
  for (VolumeId v = 0; v < world.volumes.size(); ++v) {
    if (counts[v] == 0) continue;
    const LogicalVolume& volume = world.volumes[v];
    double own = capacity(volume.solid);
    for (const Placement& p : volume.daughters) own -= capacity(world.volumes[p.volume].solid);
    const Material& material = world.materials[volume.material];
    for (const ElementShare& share : material.elements) {
      sums[share.element] += counts[v] * own / 1000 * material.density * share.fraction;
    }
  }
  return sums;
}

/// A block of lead with fibres of plastic in holes of air; cells of this kind are in a hall.
struct Calorimeter {
  DetectorBuilder builder;
  DetectorBuilder::MaterialId air, lead, plastic;
  VolumeId hall, cell, hole, fibre;

  Calorimeter() {
    const auto hydrogen = builder.element({.name = "H", .z = 1, .a = 1.008});
    const auto carbon = builder.element({.name = "C", .z = 6, .a = 12.011});
    const auto nitrogen = builder.element({.name = "N", .z = 7, .a = 14.007});
    const auto heavy = builder.element({.name = "Pb", .z = 82, .a = 207.2});
    air = builder.material({.name = "air", .density = 0.0012, .elements = {{nitrogen, 1}}});
    lead = builder.material({.name = "lead", .density = 11.35, .elements = {{heavy, 1}}});
    plastic = builder.material(
        {.name = "plastic", .density = 1.05, .elements = {{hydrogen, 0.08}, {carbon, 0.92}}});
    hall = builder.volume("hall", make_box("hall", 300, 300, 300), air);
    cell = builder.volume("cell", make_box("cell", 20, 20, 100), lead);
    hole = builder.volume("hole", make_tube("hole", 0, 0.7, 100, 0, 7), air);
    fibre = builder.volume("fibre", make_tube("fibre", 0, 0.6, 100, 0, 7), plastic);
    builder.place(fibre, hole);
    for (int i = 0; i < 100; ++i) {
      builder.place(hole, cell, placed_at({-18.0 + 4 * (i % 10), -18.0 + 4.0 * (i / 10), 0}));
    }
    for (int i = 0; i < 25; ++i) {
      builder.place(cell, hall, placed_at({-80.0 + 40 * (i % 5), -80.0 + 40.0 * (i / 5), 0}));
    }
  }
};

TEST(Mixtures, KeepMassAndElements) {
  Calorimeter c;
  const Detector detector = c.builder.build(c.hall);
  const ObservedDetector seen(detector, mixtures(0.05));
  ASSERT_EQ(seen.report().mixtures.size(), 1U);
  EXPECT_EQ(seen.report().mixtures[0].volume, "cell");
  EXPECT_EQ(seen.report().mixtures[0].of, std::vector<std::string>{"hole"});
  EXPECT_EQ(seen.report().touchables_after, 26U);
  const auto before = masses(detector), after = masses(seen.detector());
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t e = 0; e < before.size(); ++e) {
    EXPECT_NEAR(after[e], before[e], 1e-9 * before[e]) << e;
    EXPECT_GT(before[e], 0) << e;
  }
  // The radiation length of the mixture is that of its elements, and of its parts.
  const Material& mixture = seen.detector().material(seen.detector().volume(c.cell));
  const double holes = 100 * std::numbers::pi * 0.49 / 1600,
               fibres = 100 * std::numbers::pi * 0.36 / 1600;
  const auto x0 = [&](DetectorBuilder::MaterialId m) {
    return detector.material(m).radiation_length;
  };
  EXPECT_NEAR(1 / mixture.radiation_length,
              (1 - holes) / x0(c.lead) + (holes - fibres) / x0(c.air) + fibres / x0(c.plastic),
              1e-9);
}

TEST(Mixtures, HoldTheBudgetOnOtherRays) {
  for (const std::string& file : gdml_files({NAVJIT_DETECTORS_DIR})) {
    SCOPED_TRACE(file);
    const Detector detector = read_gdml(file);
    const std::vector<Ray> rays = tests::aimed_rays(detector, 4000, 77);
    for (const double budget : {1e-3, 1e-2, 0.1}) {
      const ObservedDetector seen(detector, mixtures(budget));
      const ObservationReport::Measured& m = seen.report().measured;
      EXPECT_LE(m.mean + 3 * m.mean_error, budget * m.whole);
      double change = 0, squares = 0, whole = 0;
      Runtime all(detector, {.jit = JitMode::off}), less(seen.detector(), {.jit = JitMode::off});
      Navigator every = all.navigator(), left = less.navigator();
      ObservedNavigator observed(seen, left);
      for (const Ray& ray : rays) {
        const double before = tests::radiation_lengths(every, detector, ray);
        const double difference =
            std::abs(tests::radiation_lengths(observed, seen.detector(), ray) - before);
        EXPECT_LE(difference, seen.report().bound * (1 + 1e-9) + 1e-6);
        change += difference;
        squares += difference * difference;
        whole += before;
      }
      const auto count = static_cast<double>(rays.size());
      const double mean = change / count;
      const double error = std::sqrt(std::max(squares / count - mean * mean, 0.0) / count);
      EXPECT_LE(mean - 4 * error, budget * whole / count) << budget;
    }
  }
}

TEST(Mixtures, LeaveWhatIsObservedWhereItIs) {
  Calorimeter c;
  c.builder.add_auxiliary(c.fibre, {"SensDet", "fibres"});
  const Detector detector = c.builder.build(c.hall);
  const ObservedDetector seen(detector, mixtures(10));
  EXPECT_TRUE(seen.report().mixtures.empty());
  EXPECT_EQ(seen.report().touchables_after, seen.report().touchables_before);
  // A cell that is observed may be a mixture itself: it is entered and left where it was.
  Calorimeter d;
  d.builder.add_auxiliary(d.cell, {"SensDet", "cells"});
  const Detector cells = d.builder.build(d.hall);
  const ObservedDetector coarse(cells, mixtures(0.05));
  EXPECT_EQ(coarse.report().mixtures.size(), 1U);
  Runtime all(cells, {.jit = JitMode::off}), less(coarse.detector(), {.jit = JitMode::off});
  Navigator every = all.navigator(), left = less.navigator();
  ObservedNavigator observed(coarse, left);
  const auto in_cells = [&](auto& navigator, const Detector& of, const Ray& ray, bool below) {
    std::vector<double> changes;
    double path = 0;
    bool before = false;
    transport(navigator, ray, of.tolerance(), [&](const State& at, double length) {
      const VolumeId v = at.volume();
      const bool inside = v == d.cell || (below && (v == d.hole || v == d.fibre));
      if (inside != before) changes.push_back(path);
      before = inside;
      path += length;
    });
    return changes;
  };
  for (const Ray& ray : tests::aimed_rays(cells, 500)) {
    const auto a = in_cells(every, cells, ray, true);
    const auto b = in_cells(observed, coarse.detector(), ray, false);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-9);
  }
}

TEST(Mixtures, AreNotMadeOfWhatDoesNotAddUp) {
  Calorimeter c;
  c.builder.place(c.hole, c.cell, placed_at({-17.5, -18, 0}));  // overlaps another
  const Detector detector = c.builder.build(c.hall);
  const World& world = *detector.model();
  const Marks marks = find_marks(world, mixtures(1));
  const auto rates = material_rates(world, Observation::Unit::radiation_lengths);
  const Mixtures possible(world, marks, rates);
  EXPECT_TRUE(possible.possible()[c.cell].empty());
  EXPECT_FALSE(possible.why()[c.cell].empty());
  EXPECT_EQ(possible.possible()[c.hole].size(), 1U);
}

/// Boxes in boxes, of the densities in turn: three levels deep, with eight boxes in each.
Detector nested(const std::vector<double>& densities) {
  DetectorBuilder builder;
  const auto carbon = builder.element({.name = "C", .z = 6, .a = 12.011});
  std::vector<DetectorBuilder::MaterialId> materials;
  for (std::size_t i = 0; i < densities.size(); ++i) {
    materials.push_back(builder.material(
        {.name = "m" + std::to_string(i), .density = densities[i], .elements = {{carbon, 1}}}));
  }
  double half = 1;
  VolumeId inner = builder.volume("v0", make_box("v0", half, half, half), materials[0]);
  for (std::size_t level = 1; level < 4; ++level) {
    const double at = 1.2 * half;
    half *= 3;
    const std::string name = "v" + std::to_string(level);
    const VolumeId outer =
        builder.volume(name, make_box(name, half, half, half), materials[level % materials.size()]);
    for (int i = 0; i < 8; ++i) {
      builder.place(
          inner, outer,
          placed_at({(i & 1) != 0 ? at : -at, (i & 2) != 0 ? at : -at, (i & 4) != 0 ? at : -at}));
    }
    inner = outer;
  }
  return builder.build(inner);
}

TEST(Mixtures, OfVacuumAndLeadKeepTheBudget) {
  for (const std::vector<double>& densities :
       {std::vector<double>{1e-25, 20}, {20, 1e-25}, {1e-25, 1e-25}, {0, 20}, {0, 1e-25}, {5}}) {
    for (const double budget : {1e-6, 1e-2, 0.3}) {
      SCOPED_TRACE(testing::PrintToString(densities) + " " + std::to_string(budget));
      const Detector detector = nested(densities);
      const ObservedDetector seen(detector, mixtures(budget));
      const ObservationReport::Measured& m = seen.report().measured;
      EXPECT_LE(m.mean + 3 * m.mean_error, budget * m.whole);
      EXPECT_LE(m.largest, seen.report().bound * (1 + 1e-9));
      const auto before = masses(detector), after = masses(seen.detector());
      EXPECT_NEAR(after[0], before[0], 1e-9 * before[0]);
      // What is the same everywhere is one at any budget.
      if (densities.size() == 1) {
        EXPECT_EQ(seen.report().touchables_after, 1U);
      }
    }
  }
}

TEST(Mixtures, OfNothingAtAllAreNothing) {
  const ObservedDetector seen(nested({0}), mixtures(0.01));
  EXPECT_EQ(seen.report().measured.whole, 0);
  EXPECT_EQ(seen.report().measured.largest, 0);
  EXPECT_EQ(seen.report().touchables_after, 1U);
}

TEST(Mixtures, NeedRaysThatMeetTheDetector) {
  Observation from_outside = mixtures(0.01);
  from_outside.rays.origin = Vec3{1e6, 0, 0};
  EXPECT_THROW(ObservedDetector(nested({1, 2}), from_outside), GeometryError);
  EXPECT_THROW(ObservedDetector(nested({1, 2}), mixtures(0)), GeometryError);
}

TEST(Mixtures, KnowTheOriginal) {
  Calorimeter c;
  const Detector detector = c.builder.build(c.hall);
  const ObservedDetector seen(detector, mixtures(0.05));
  Runtime less(seen.detector(), {.jit = JitMode::off});
  Navigator navigator = less.navigator();
  const Vec3 point{-18, -18, 5};  // of the middle cell, where a fibre was
  const State at = navigator.locate(point, {0, 0, 1});
  EXPECT_EQ(at.volume(), c.cell);
  const State original = seen.original(at, point, {0, 0, 1});
  EXPECT_EQ(original.volume(), c.fibre);
  EXPECT_EQ(detector.depth(original), 3);
  EXPECT_EQ(seen.original(at).volume(), c.cell);
}

TEST(Mixtures, AreTheSameWhenWrittenAndRead) {
  Calorimeter c;
  const ObservedDetector seen(c.builder.build(c.hall), mixtures(0.05));
  const tests::TemporaryFolder folder;
  tests::write_file(folder.file("written.gdml"), gdml_text(seen.detector()));
  const Detector again = read_gdml(folder.file("written.gdml"));
  const auto find = [](const Detector& d) { return d.material(d.volume(*d.find_volume("cell"))); };
  const Material was = find(seen.detector()), is = find(again);
  EXPECT_NEAR(is.density, was.density, 1e-12);
  EXPECT_NEAR(is.radiation_length, was.radiation_length, 1e-9);
  ASSERT_EQ(is.elements.size(), was.elements.size());
  EXPECT_EQ(was.elements.size(), 4U);
}

TEST(Mixtures, OfPublishedDetectorsKeepTheirMass) {
  std::vector<std::string> given{NAVJIT_DETECTORS_DIR};
  if (fs::is_directory(NAVJIT_DATA_DIR)) given.emplace_back(NAVJIT_DATA_DIR);
  std::size_t made = 0;
  for (const std::string& file : gdml_files(given)) {
    SCOPED_TRACE(file);
    try {
      const Detector detector = read_gdml(file);
      if (detector.touchables() > 20000) continue;  // larger ones take seconds each
      const ObservedDetector seen(detector, mixtures(0.03));
      made += seen.report().mixtures.size();
      for (const ObservationReport::Mixture& m : seen.report().mixtures) {
        EXPECT_GE(m.density, 0);
        EXPECT_FALSE(m.of.empty());
      }
      const auto before = masses(detector), after = masses(seen.detector());
      for (std::size_t e = 0; e < before.size(); ++e) {
        if (!std::isfinite(before[e]) || !std::isfinite(after[e])) continue;  // of booleans
        EXPECT_NEAR(after[e], before[e], 1e-6 * std::abs(before[e])) << e;
      }
    } catch (const GdmlError&) {      // some are of solids that cannot be
    } catch (const GeometryError&) {  // or of nothing that a ray meets
    }
  }
  EXPECT_GT(made, given.size() > 1 ? 10U : 5U);  // the shipped ones alone make fewer
}

}  // namespace
}  // namespace navjit
