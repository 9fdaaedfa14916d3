// ROOT's volumes, placements and materials, as the detector has them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "navjit/runtime.hpp"
#include "tests/support/root_reading.hpp"

namespace navjit {
namespace {

using namespace tests;
using Numbers = std::vector<double>;

class RootStructure : public RootReading {
 protected:
  static std::string at(const Detector& detector, const Vec3& point) {
    Runtime runtime{detector, {.jit = JitMode::off}};
    const State state = runtime.navigator().locate(point);
    return state.inside() ? detector.path_of(state) : "outside";
  }
};

/// The rows of a random rotation, or of a rotation with a reflection.
Numbers random_rows(std::mt19937_64& random, bool reflects) {
  std::normal_distribution<double> normal;
  double r[3][3];
  for (int i = 0; i < 2; ++i) {
    for (double& x : r[i]) x = normal(random);
    for (int j = 0; j < i; ++j) {
      double along = 0;
      for (int k = 0; k < 3; ++k) along += r[i][k] * r[j][k];
      for (int k = 0; k < 3; ++k) r[i][k] -= along * r[j][k];
    }
    const double length = std::hypot(r[i][0], r[i][1], r[i][2]);
    for (double& x : r[i]) x /= length;
  }
  for (int k = 0; k < 3; ++k) {
    const int m = (k + 1) % 3, n = (k + 2) % 3;
    r[2][k] = (reflects ? -1 : 1) * (r[0][m] * r[1][n] - r[0][n] * r[1][m]);
  }
  return {r[0][0], r[0][1], r[0][2], r[1][0], r[1][1], r[1][2], r[2][0], r[2][1], r[2][2]};
}

TEST_F(RootStructure, MatricesTakeLocalPointsToTheMother) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-100, 100);
  for (int i = 0; i < 60; ++i) {
    const Numbers rows = random_rows(random, i % 2 == 1);
    Numbers t{uniform(random), uniform(random), uniform(random)};
    RootPointer matrix;
    if (i % 3 == 0) {
      matrix = root_placed(t[0], t[1], t[2], rows);
    } else if (i % 3 == 1) {
      matrix = root_object(
          "TGeoHMatrix", "",
          {{"fTranslation", t}, {"fRotationMatrix", rows}, {"fScale", Numbers{1, 1, 1}}});
    } else {
      matrix = root_rotation(rows);
      t = {0, 0, 0};
    }
    const RootPointer inner = root_volume("inner", root_box("box", 1, 2, 3));
    const Detector detector = read(root_volume("world", root_box("hall", 500, 500, 500),
                                               {root_node("placed", inner, 7, matrix)}));
    const Placement& placement = detector.volume(detector.world_volume()).daughters.at(0);
    EXPECT_EQ(placement.name, "placed");
    EXPECT_EQ(placement.copy_number, 7);
    for (int k = 0; k < 10; ++k) {
      const double p[3] = {uniform(random), uniform(random), uniform(random)};
      const Vec3 found = to_outer(placement.transformation, {10 * p[0], 10 * p[1], 10 * p[2]});
      double wanted[3];
      for (std::size_t j = 0; j < 3; ++j) {
        wanted[j] =
            10 * (t[j] + rows[3 * j] * p[0] + rows[3 * j + 1] * p[1] + rows[3 * j + 2] * p[2]);
      }
      EXPECT_NEAR(found.x, wanted[0], 1e-9);
      EXPECT_NEAR(found.y, wanted[1], 1e-9);
      EXPECT_NEAR(found.z, wanted[2], 1e-9);
    }
  }
}

TEST_F(RootStructure, RoughMatricesAreMadeExactAndWrongOnesRefused) {
  const RootPointer inner = root_volume("inner", root_box("box", 1, 2, 3));
  const auto world = [&](const RootPointer& matrix) {
    return root_volume("world", root_box("hall", 500, 500, 500),
                       {root_node("placed", inner, 7, matrix)});
  };
  GdmlReport report;
  const Detector detector = read(world(root_rotation({1, 1e-4, 0, 0, 1, 0, 0, 0, 1})), &report);
  const auto& r = detector.volume(detector.world_volume()).daughters[0].transformation.rotation;
  EXPECT_NEAR(r[0] * r[3] + r[1] * r[4] + r[2] * r[5], 0, 1e-15);
  ASSERT_EQ(report.skipped.size(), 1U);
  EXPECT_NE(report.skipped[0].find("orthonormal"), std::string::npos);
  EXPECT_NE(refusal(world(root_rotation({1, 0.5, 0, 0, 1, 0, 0, 0, 1}))), "");
  EXPECT_NE(refusal(world(root_rotation({0, 0, 0, 0, 0, 0, 0, 0, 0}))), "");
  EXPECT_NE(refusal(world(root_object("TGeoScale", "big", {{"fScale", Numbers{2, 1, 1}}}))), "");
  EXPECT_EQ(refusal(world(root_object("TGeoScale", "mirror", {{"fScale", Numbers{1, 1, -1}}}))),
            "");
}

TEST_F(RootStructure, SharedVolumesAreReadOnce) {
  const RootPointer leaf = root_volume("leaf", root_box("leafbox", 1, 1, 1));
  const RootPointer pair = root_volume("pair", root_box("pairbox", 10, 2, 2),
                                       {root_node("leaf_1", leaf, 1, root_translation(-5, 0, 0)),
                                        root_node("leaf_2", leaf, 2, root_translation(5, 0, 0))});
  const Detector detector =
      read(root_volume("world", root_box("hall", 50, 50, 50),
                       {root_node("pair_1", pair, 1, root_translation(0, -10, 0)),
                        root_node("pair_2", pair, 2, root_translation(0, 10, 0))}));
  EXPECT_EQ(detector.volumes(), 3U);
  EXPECT_EQ(detector.materials(), 1U);
  EXPECT_EQ(detector.touchables(), 7U);
  EXPECT_EQ(at(detector, {50, 100, 0}), "world/pair_2/leaf_2");
  EXPECT_EQ(at(detector, {-50, -100, 0}), "world/pair_1/leaf_1");
  EXPECT_EQ(at(detector, {0, -100, 0}), "world/pair_1");
  EXPECT_EQ(at(detector, {0, 0, 501}), "outside");
}

TEST_F(RootStructure, AssembliesAreDissolved) {
  const RootPointer leaf = root_volume("leaf", root_box("leafbox", 1, 1, 1));
  const auto assembly = [&](const std::string& name, const std::vector<RootPointer>& nodes) {
    return root_volume(name, root_object("TGeoShapeAssembly", "", {}), nodes, {});
  };
  const RootPointer row =
      assembly("row", {root_node("leaf_1", leaf, 1, root_translation(-5, 0, 0)),
                       root_node("leaf_2", leaf, 2, root_translation(5, 0, 0))});
  // A quarter turn about z.
  const RootPointer cross =
      assembly("cross", {root_node("row_1", row, 1, root_translation(0, 0, 0)),
                         root_node("row_2", row, 2, root_rotation({0, -1, 0, 1, 0, 0, 0, 0, 1}))});
  const Detector detector =
      read(root_volume("world", root_box("hall", 50, 50, 50),
                       {root_node("cross_1", cross, 1, root_translation(0, 0, 20))}));
  EXPECT_EQ(detector.volumes(), 2U);
  EXPECT_EQ(at(detector, {50, 0, 200}), "world/cross_1.row_1.leaf_2");
  EXPECT_EQ(at(detector, {0, 50, 200}), "world/cross_1.row_2.leaf_2");
  EXPECT_EQ(at(detector, {0, 0, 200}), "world");

  // On top it gets a box.
  GdmlReport report;
  const Detector alone = read(cross, &report);
  EXPECT_EQ(at(alone, {0, -50, 0}), "cross/row_2.leaf_1");
  EXPECT_EQ(at(alone, {0, 0, 0}), "cross");
  ASSERT_EQ(report.skipped.size(), 1U);
  EXPECT_NE(refusal(assembly("nothing", {})).find("it is empty"), std::string::npos);
}

TEST_F(RootStructure, FlatVolumesHoldNothing) {
  const RootPointer leaf = root_volume("leaf", root_box("leafbox", 1, 1, 1));
  const RootPointer flat = root_volume("flat", root_box("flatbox", 4, 0, 4));
  GdmlReport report;
  const Detector detector =
      read(root_volume("world", root_box("hall", 50, 50, 50),
                       {root_node("flat_1", flat, 1, root_translation(0, 3, 0)),
                        root_node("leaf_1", leaf, 1, root_translation(0, 9, 0)),
                        root_node("flat_2", flat, 2, root_translation(0, 12, 0))}),
           &report);
  EXPECT_EQ(detector.touchables(), 2U);
  EXPECT_EQ(at(detector, {0, 30, 0}), "world");
  EXPECT_EQ(at(detector, {0, 90, 0}), "world/leaf_1");
  ASSERT_EQ(report.skipped.size(), 1U);
  EXPECT_NE(report.skipped[0].find("flat volumes"), std::string::npos);
  EXPECT_NE(report.skipped[0].find("(2)"), std::string::npos);
  // What it would hold is not lost quietly, nor is a world without an inside read.
  const RootPointer full = root_volume("full", root_box("fullbox", 4, 0, 4),
                                       {root_node("leaf_1", leaf, 1, root_translation(0, 0, 0))});
  EXPECT_NE(refusal(root_volume("world", root_box("hall", 50, 50, 50),
                                {root_node("full_1", full, 1, root_translation(0, 0, 0))}))
                .find("fullbox"),
            std::string::npos);
  EXPECT_NE(refusal(flat).find("flatbox"), std::string::npos);
}

TEST_F(RootStructure, DivisionsAreWrittenOut) {
  const auto divided = [&](const std::string& pattern, const RootPointer& mother_shape,
                           const RootPointer& slice_shape, double start, double step) {
    const RootPointer finder =
        root_object(pattern, "", {{"fStep", step}, {"fStart", start}, {"fEnd", 0.0}});
    const RootPointer slice = root_volume("slice", slice_shape);
    std::vector<RootPointer> nodes;
    for (int i = 0; i < 4; ++i) {
      const std::string name = "slice_" + std::to_string(i + 1);
      const RootPointer base =
          root_object("TGeoNode", name, {{"fVolume", slice}, {"fNumber", i + 1}});
      const RootPointer node = root_object(
          "TGeoNodeOffset", name,
          {{"TGeoNode", RootBase{base}}, {"fOffset", 0.0}, {"fIndex", i}, {"fFinder", finder}});
      node->named = false;
      nodes.push_back(node);
    }
    return read(root_volume("mother", mother_shape, nodes));
  };
  const RootPointer cube = root_box("cube", 4, 4, 4);
  Detector detector = divided("TGeoPatternX", cube, root_box("s", 1, 4, 4), -4, 2);
  EXPECT_EQ(at(detector, {-30, 20, 20}), "mother/slice_1");
  EXPECT_EQ(at(detector, {30, 20, 20}), "mother/slice_4");
  detector = divided("TGeoPatternY", cube, root_box("s", 4, 1, 4), -4, 2);
  EXPECT_EQ(at(detector, {20, 10, 20}), "mother/slice_3");
  detector = divided("TGeoPatternZ", cube, root_box("s", 4, 4, 0.5), -3, 1);
  EXPECT_EQ(at(detector, {0, 0, -25}), "mother/slice_1");
  EXPECT_EQ(at(detector, {0, 0, -35}), "mother");
  EXPECT_EQ(at(detector, {0, 0, 5}), "mother/slice_4");

  const auto tube = [](double from, double to) {
    return root_object(
        "TGeoTubeSeg", "tube",
        {{"fRmin", 0.0}, {"fRmax", 4.0}, {"fDz", 4.0}, {"fPhi1", from}, {"fPhi2", to}});
  };
  // ROOT has the slice's middle at azimuth 0.
  detector = divided("TGeoPatternCylPhi", tube(0, 360), tube(-45, 45), 0, 90);
  EXPECT_EQ(at(detector, {20, 10, 0}), "mother/slice_1");
  EXPECT_EQ(at(detector, {-10, 20, 0}), "mother/slice_2");
  EXPECT_EQ(at(detector, {10, -20, 0}), "mother/slice_4");

  const auto para = [](double x, double y, double z) {
    return root_object(
        "TGeoPara", "para",
        {{"fX", x}, {"fY", y}, {"fZ", z}, {"fAlpha", 45.0}, {"fTheta", 45.0}, {"fPhi", 0.0}});
  };
  detector = divided("TGeoPatternParaX", para(4, 4, 4), para(1, 4, 4), -4, 2);
  EXPECT_EQ(at(detector, {10, 0, 0}), "mother/slice_3");
  EXPECT_EQ(at(detector, {10 + 30, 30, 0}), "mother/slice_3");
  detector = divided("TGeoPatternParaY", para(4, 4, 4), para(4, 1, 4), -4, 2);
  EXPECT_EQ(at(detector, {30, 30, 0}), "mother/slice_4");
  EXPECT_EQ(at(detector, {-15, 30, 0}), "outside");
  EXPECT_EQ(at(detector, {30 + 39, 30, 0}), "mother/slice_4");
  detector = divided("TGeoPatternParaZ", para(4, 4, 4), para(4, 4, 1), -4, 2);
  EXPECT_EQ(at(detector, {30 + 39, 0, 30}), "mother/slice_4");
  EXPECT_THROW(divided("TGeoPatternSphR", cube, cube, 0, 1), RootError);
}

TEST_F(RootStructure, WhatMayOverlapIsNoted) {
  const RootPointer leaf = root_volume("leaf", root_box("leafbox", 1, 1, 1));
  GdmlReport report;
  read(root_volume("world", root_box("hall", 50, 50, 50),
                   {root_node("leaf_1", leaf, 1, root_translation(0, 0, 0), 0x03000000 | 1U << 17),
                    root_node("leaf_2", leaf, 2, root_translation(1, 0, 0), 0x03000000 | 1U << 13),
                    root_node("leaf_3", leaf, 3, root_translation(9, 0, 0))}),
       &report);
  ASSERT_EQ(report.skipped.size(), 1U);
  EXPECT_NE(report.skipped[0].find("many"), std::string::npos);
  EXPECT_NE(report.skipped[0].find("(2)"), std::string::npos);
}

TEST_F(RootStructure, MaterialsHaveElements) {
  const auto element = [](const std::string& name, int z, double a) {
    return root_object("TGeoElement", name,
                       {{"fZ", z},
                        {"fA", a},
                        {"fAbundances", RootCounted{"fNisotopes", {}}},
                        {"fIsotopes", RootList{}}});
  };
  const RootPointer hydrogen = element("H", 1, 1.00794), oxygen = element("O", 8, 15.9994);
  const RootPointer plain = root_material("Water", 7, 14, 1);
  plain->named = true;
  const RootPointer water = root_object("TGeoMixture", "Water",
                                        {{"TGeoMaterial", RootBase{plain}},
                                         {"fZmixture", RootCounted{"fNelements", {1, 8}}},
                                         {"fAmixture", RootCounted{"", {1.00794, 15.9994}}},
                                         {"fWeights", RootCounted{"", {0.111894, 0.888106}}},
                                         {"fElements", RootList{{hydrogen, oxygen}}}});
  water->named = false;
  const RootPointer vacuum = root_medium("nothing", root_material("Vacuum", 0, 0, 0));
  const RootPointer tank =
      root_volume("tank", root_box("tankbox", 1, 1, 1), {}, root_medium("w", water));
  const RootPointer bare = root_volume("bare", root_box("barebox", 1, 1, 1), {}, {});
  const RootPointer brick = root_volume("brick", root_box("brickbox", 1, 1, 1));
  const auto empty = [&](const char* name, double density) {
    return root_volume(name, root_box("emptybox", 1, 1, 1), {},
                       root_medium("nothing", root_material("Vacuum", 0, 0, density)));
  };
  GdmlReport report;
  const Detector detector = read(
      root_volume("world", root_box("hall", 50, 50, 50),
                  {root_node("a", tank, 1, {}), root_node("b", bare, 1, root_translation(5, 0, 0)),
                   root_node("c", brick, 1, root_translation(9, 0, 0)),
                   root_node("d", empty("bottle", 1e-16), 1, root_translation(13, 0, 0)),
                   root_node("e", empty("odd", 1), 1, root_translation(17, 0, 0))},
                  vacuum),
      &report);
  const auto material = [&](const std::string& name) {
    return detector.material(detector.volume(*detector.find_volume(name)));
  };
  const Material liquid = material("tank");
  EXPECT_EQ(liquid.name, "Water");
  EXPECT_EQ(liquid.density, 1);
  EXPECT_EQ(liquid.temperature, 300);
  EXPECT_EQ(liquid.state, MaterialState::solid);
  ASSERT_EQ(liquid.elements.size(), 2U);
  EXPECT_EQ(detector.element(liquid.elements[1].element).name, "O");
  EXPECT_NEAR(liquid.elements[1].fraction, 0.888106, 1e-9);
  EXPECT_NEAR(liquid.radiation_length, 360.8, 0.5);
  EXPECT_NEAR(material("brick").radiation_length, 5.61, 0.02);
  EXPECT_EQ(material("world").name, "Vacuum");
  EXPECT_TRUE(material("world").elements.empty());
  // 0 is what a density is that is not known.
  EXPECT_EQ(material("world").density, 1e-25);
  EXPECT_EQ(material("bottle").density, 1e-16);
  EXPECT_EQ(material("odd").density, 1e-25);
  EXPECT_EQ(material("bare").name, "");
  ASSERT_EQ(report.skipped.size(), 2U);
  EXPECT_NE(report.skipped[0].find("without charge"), std::string::npos);
  EXPECT_NE(report.skipped[1].find("no medium"), std::string::npos);
}

TEST_F(RootStructure, NamesCanBeWrittenAnywhere) {
  const RootPointer box = root_box("box", 1, 1, 1);
  const auto name = [&](const std::string& given) {
    const Detector detector = read(root_volume(given, box));
    return detector.volume(detector.world_volume()).name;
  };
  EXPECT_EQ(name("a\nb\x01"), "a?b?");
  EXPECT_EQ(name("\xc3\xa9\xf0\x9f\x98\x80"), "\xc3\xa9\xf0\x9f\x98\x80");
  EXPECT_EQ(name("\xe9t\xe9"), "\xc3\xa9t\xc3\xa9");            // Latin-1
  EXPECT_EQ(name("\xed\xa0\x80"), "\xc3\xad\xc2\xa0\xc2\x80");  // half a pair
  EXPECT_EQ(name("\xef\xbf\xbf"), "\xc3\xaf\xc2\xbf\xc2\xbf");  // no character
  EXPECT_EQ(name("\xc0\xaf"), "\xc3\x80\xc2\xaf");              // too long
  EXPECT_EQ(name("\xc3"), "\xc3\x83");                          // cut off
  EXPECT_EQ(name(std::string(60'000, 'x')).size(), 60'000U);
  EXPECT_NE(refusal(root_volume(std::string(70'000, 'x'), box)).find("a name has"),
            std::string::npos);
}

TEST_F(RootStructure, CyclesAndDepthsAreRefused) {
  const RootPointer loop = root_volume("loop", root_box("box", 1, 1, 1));
  const RootPointer node = root_node("again", loop, 1, {});
  std::get<RootList>(loop->members[0].second).objects.push_back(node);
  EXPECT_NE(refusal(loop).find("within itself"), std::string::npos);
  std::get<RootList>(loop->members[0].second).objects.clear();

  RootPointer deep = root_volume("deep", root_box("box", 1, 1, 1));
  for (int i = 0; i < 300; ++i) {
    deep = root_volume("deep", root_box("box", 1, 1, 1), {root_node("n", deep, 1, {})});
  }
  EXPECT_NE(refusal(deep).find("deep"), std::string::npos);
  // Assemblies that multiply.
  RootPointer many = root_volume("leaf", root_box("box", 1, 1, 1));
  for (int i = 0; i < 30; ++i) {
    many = root_volume("twice", root_object("TGeoShapeAssembly", "", {}),
                       {root_node("a", many, 1, {}), root_node("b", many, 2, {})}, {});
  }
  EXPECT_NE(refusal(many).find("placements"), std::string::npos);
}

}  // namespace
}  // namespace navjit
