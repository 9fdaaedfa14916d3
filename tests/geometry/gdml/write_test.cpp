// What is written as GDML is read back as the same detector.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "geometry/solids/extent.hpp"
#include "navjit/builder.hpp"
#include "navjit/gdml.hpp"
#include "tests/campaign/files.hpp"
#include "tests/campaign/random_scene.hpp"
#include "tests/geometry/gdml/gdml_files.hpp"
#include "tests/geometry/gdml/same_traces.hpp"
#include "tests/geometry/kernels/random_curved_solids.hpp"
#include "tests/geometry/kernels/random_flat_solids.hpp"
#include "tests/support/worlds.hpp"

namespace navjit::testing {
namespace {

namespace fs = std::filesystem;

void expect_same_tags(const Auxiliaries& a, const Auxiliaries& b) {
  ASSERT_EQ(a != nullptr, b != nullptr);
  if (!a) return;
  ASSERT_EQ(a->size(), b->size());
  for (std::size_t i = 0; i < a->size(); ++i) {
    EXPECT_EQ((*a)[i].type, (*b)[i].type);
    EXPECT_EQ((*a)[i].value, (*b)[i].value);
    EXPECT_EQ((*a)[i].unit, (*b)[i].unit);
    EXPECT_EQ((*a)[i].children.size(), (*b)[i].children.size());
  }
}

void expect_same_material(const Detector& a, const Material& x, const Detector& b,
                          const Material& y) {
  EXPECT_EQ(x.name, y.name);
  EXPECT_DOUBLE_EQ(x.density, y.density) << x.name;
  EXPECT_EQ(x.state, y.state) << x.name;
  EXPECT_DOUBLE_EQ(x.temperature, y.temperature) << x.name;
  EXPECT_DOUBLE_EQ(x.pressure, y.pressure) << x.name;
  EXPECT_NEAR(x.radiation_length, y.radiation_length, 1e-12 * x.radiation_length) << x.name;
  ASSERT_EQ(x.elements.size(), y.elements.size()) << x.name;
  for (std::size_t i = 0; i < x.elements.size(); ++i) {
    EXPECT_NEAR(x.elements[i].fraction, y.elements[i].fraction, 1e-15) << x.name;
    const Element &e = a.element(x.elements[i].element), &f = b.element(y.elements[i].element);
    EXPECT_EQ(e.z, f.z) << x.name;
    EXPECT_NEAR(e.a, f.a, 1e-12 * e.a) << x.name;
    EXPECT_EQ(e.isotopes.size(), f.isotopes.size()) << x.name;
  }
}

/// Expects the same tree, by names and numbers; the order of the volumes may differ.
void expect_same_tree(const Detector& a, const Detector& b) {
  EXPECT_EQ(a.touchables(), b.touchables());
  EXPECT_EQ(a.levels(), b.levels());
  expect_same_tags(a.auxiliaries(), b.auxiliaries());
  std::vector<std::optional<VolumeId>> partner(a.volumes());
  std::vector<VolumeId> waiting{a.world_volume()};
  partner[a.world_volume()] = b.world_volume();
  while (!waiting.empty()) {
    const VolumeId id = waiting.back();
    waiting.pop_back();
    const LogicalVolume &x = a.volume(id), &y = b.volume(*partner[id]);
    expect_same_tags(x.auxiliaries, y.auxiliaries);
    expect_same_material(a, a.material(x), b, b.material(y));
    ASSERT_EQ(x.daughters.size(), y.daughters.size()) << x.name;
    for (std::size_t i = 0; i < x.daughters.size(); ++i) {
      const Placement &p = x.daughters[i], &q = y.daughters[i];
      EXPECT_EQ(p.name, q.name);
      EXPECT_EQ(p.copy_number, q.copy_number);
      expect_same_tags(p.auxiliaries, q.auxiliaries);
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(p.transformation.translation[k], q.transformation.translation[k]);
      }
      for (int k = 0; k < 9; ++k) {
        // Matrices that files give are orthonormal to 1e-6 only; angles are so to the last bit.
        EXPECT_NEAR(p.transformation.rotation[k], q.transformation.rotation[k], 4e-16) << p.name;
      }
      if (!partner[p.volume]) waiting.push_back(p.volume);
      if (!partner[p.volume]) partner[p.volume] = q.volume;
      EXPECT_EQ(*partner[p.volume], q.volume);
    }
  }
}

class GdmlWriter : public GdmlFiles {
 protected:
  Detector read_back(const Detector& detector) const {
    return read_gdml(write("written.gdml", gdml_text(detector)));
  }
  void expect_read_back(const Detector& detector, int rays) const {
    const Detector again = read_back(detector);
    expect_same_tree(detector, again);
    expect_same_traces(*detector.model(), *again.model(), rays);
  }
};

TEST_F(GdmlWriter, WritesTheShippedDetectors) {
  for (const std::string& file : gdml_files({NAVJIT_DETECTORS_DIR})) {
    SCOPED_TRACE(file);
    expect_read_back(read_gdml(file), 200);
  }
}

TEST_F(GdmlWriter, WritesPublishedDetectors) {
  const fs::path folder = NAVJIT_DATA_DIR;
  if (!fs::is_directory(folder)) GTEST_SKIP() << folder << " is not here";
  int written = 0;
  for (const std::string& file : gdml_files({folder.string()})) {
    SCOPED_TRACE(file);
    std::optional<Detector> detector;
    try {
      detector = read_gdml(file);
    } catch (const GdmlError&) {  // some are of solids that cannot be
      continue;
    }
    expect_read_back(*detector, 100);
    ++written;
  }
  EXPECT_GT(written, 70);
}

TEST_F(GdmlWriter, WritesRandomScenes) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    const std::string text = campaign::random_scene(seed, 60, campaign::scene_kinds());
    expect_read_back(read_gdml(write("scene.gdml", text)), 500);
  }
}

TEST_F(GdmlWriter, WritesEveryKindOfSolid) {
  std::set<SolidKind> kinds;
  const auto one_of = [&](const test::Maker& maker, std::uint64_t seed) {
    SCOPED_TRACE(std::string(maker.name) + " " + std::to_string(seed));
    test::Random random(seed);
    const Solid solid = maker.make(random).solid;
    kinds.insert(solid.kind);
    const double half = 1.3 * largest_coordinate(solid.extent);
    DetectorBuilder builder;
    const auto air = builder.material({.name = "air", .density = 0.001});
    const auto hall = builder.volume("hall", make_box("hall", half, half, half), air);
    builder.place(builder.volume("solid", solid, air), hall);
    const Detector detector = builder.build(hall);
    const Detector again = read_back(detector);
    // The same points are in both, but for those on the surface.
    const auto same = again.volume(again.volume(again.world_volume()).daughters[0].volume).solid;
    for (int i = 0; i < 400; ++i) {
      const auto any = [&] { return random.uniform(-half, half); };
      const Vec3 p{any(), any(), any()};
      const Direction v = kernels::make_direction(0.6, 0.0, 0.8);
      const double in = distance_to_in(solid.any(), p, v, 0.0);
      const double tolerance = 1e-9 * half;
      const Side a = kernels::inside(solid.any(), p, tolerance);
      const Side b = kernels::inside(same.any(), p, tolerance);
      EXPECT_TRUE(a == Side::surface || b == Side::surface || a == b) << maker.name;
      if (a != Side::outside) continue;
      const double again_in = distance_to_in(same.any(), p, v, 0.0);
      // Rays that graze may miss one of them.
      if (std::isfinite(in) && std::isfinite(again_in)) {
        EXPECT_NEAR(in, again_in, 1e-6 * half) << maker.name;
      }
    }
  };
  const auto all_of = [&](const auto& makers) {
    for (const test::Maker& maker : makers) {
      for (std::uint64_t seed = 1; seed <= 12; ++seed) one_of(maker, seed);
    }
  };
  all_of(test::primitive_makers);
  all_of(test::composite_makers);
  all_of(test::flat_makers);
  all_of(test::curved_makers);
  for (int kind = 0; kind <= static_cast<int>(SolidKind::subtraction_of); ++kind) {
    const auto one = static_cast<SolidKind>(kind);
    if (one == SolidKind::placed) continue;  // within others only
    EXPECT_TRUE(kinds.contains(one)) << kind_name(one);
  }
}

TEST_F(GdmlWriter, WritesSolidsThatAreSeveralInGdml) {
  // A contour that turns back in z has two rings at one height; a solid that is moved by itself; an
  // arb8 with an edge of no length, a tetrahedron.
  const ContourPoint hook[] = {{1, -8}, {9, -8}, {9, 8}, {6, 8}, {6, -4}, {3, -4}, {3, 6}, {1, 6}};
  const PlanarPoint wedge[8] = {{-5, -5}, {5, -5}, {5, 5}, {5, 5},
                                {-4, -6}, {6, -4}, {4, 6}, {4, 6}};
  SolidFrame frame{{3, 1, -2}, {}};
  const Transformation turned = placed_at({3, 1, -2}, {0.5, 1, 2});
  std::copy_n(turned.rotation, 9, frame.rotation);
  const Solid box = make_box("box", 2, 3, 4);
  const std::vector<Solid> solids{
      make_generic_polycone("polycone", hook, 0.3, 5),
      make_generic_polycone("whole", hook, 0, 7),
      make_generic_polyhedra("polyhedra", hook, 5, 0.2, 4),
      make_placed("placed", make_placed("inner", box, frame), frame),
      make_scaled("scaled", make_placed("inner", box, frame), 1, -1.5, 0.7),
      make_arb8("arb8", 6, wedge),
      make_tet("tet", {-5, -5, -5}, {7, 0, 0}, {0, 8, 1}, {1, 2, 9}),
      make_twistedtubs("asymmetric", 0.7, 2, 6, -3, 8, 2),
      make_twistedtrap("bent", 0.6, 8, 0.2, 0.4, 4, 3, 5, 6, 4, 4.5, 0.2),
      make_sphere("cap", 2, 9, 0.5, 3, 0.3, 1.0),
      make_sphere("bowl", 0, 9, 0, 7, 1.9, 1.0)};
  for (const Solid& solid : solids) {
    SCOPED_TRACE(solid.name);
    DetectorBuilder builder;
    const auto air = builder.material({.name = "air", .density = 0.001});
    const auto hall = builder.volume("hall", make_box("hall", 20, 20, 20), air);
    builder.place(builder.volume("solid", solid, air), hall);
    expect_read_back(builder.build(hall), 2000);
  }
}

TEST_F(GdmlWriter, GivesAVacuumAnElement) {
  // Geant4 ends a run where a material has none.
  DetectorBuilder builder;
  const auto in_a_box = [&](const char* name, double density) {
    return builder.volume(name, make_box(name, 1, 1, 1),
                          builder.material({.name = name, .density = density}));
  };
  const auto world =
      builder.volume("world", make_box("hall", 9, 9, 9), builder.material({.name = "hall"}));
  builder.place(in_a_box("space", 1e-25), world, placed_at({3, 0, 0}));
  builder.place(in_a_box("unknown", 3), world, placed_at({-3, 0, 0}));
  const Detector again = read_back(builder.build(world));
  const auto material = [&](const char* name) {
    return again.material(again.volume(*again.find_volume(name)));
  };
  ASSERT_EQ(material("space").elements.size(), 1U);
  EXPECT_EQ(again.element(material("space").elements[0].element).z, 1);
  EXPECT_EQ(material("space").density, 1e-25);
  // What is of something is not said to be of hydrogen.
  EXPECT_TRUE(material("unknown").elements.empty());
  EXPECT_EQ(material("unknown").density, 3);
}

TEST_F(GdmlWriter, TellsThingsOfOneNameApart) {
  DetectorBuilder builder;
  const auto iron = builder.element({.name = "iron", .formula = "Fe", .z = 26, .a = 55.8});
  const auto first = builder.material({.name = "iron", .density = 7, .elements = {{iron, 1}}});
  const auto second = builder.material({.name = "iron", .density = 8, .elements = {{iron, 1}}});
  const auto hall = builder.volume("a <b> & \"c\"", make_box("solid", 50, 50, 50), first);
  const auto brick = builder.volume("twin", make_box("solid", 5, 5, 5), second);
  const auto other = builder.volume("twin", make_box("solid", 4, 4, 4), first);
  builder.place(brick, hall, placed_at({10, 0, 0}, {0.3, -0.2, 3}), 4, "tab\tline\nend");
  builder.place(other, hall, placed_at({-10, 0, 0}, {0, M_PI / 2, 0.7}), -2);
  builder.add_auxiliary(brick, {"SensDet", "x > y", "mm", {{"child", "1"}}});
  const Detector detector = builder.build(hall);
  const Detector again = read_back(detector);
  EXPECT_EQ(again.volume(again.world_volume()).name, "a <b> & \"c\"");
  const auto& daughters = again.volume(again.world_volume()).daughters;
  ASSERT_EQ(daughters.size(), 2U);
  EXPECT_EQ(daughters[0].name, "tab\tline\nend");
  EXPECT_EQ(daughters[1].copy_number, -2);
  EXPECT_EQ(again.volume(daughters[0].volume).name, "twin");
  EXPECT_EQ(again.volume(daughters[1].volume).name, "twin_2");
  EXPECT_EQ(again.material(again.volume(daughters[0].volume)).density, 8);
  expect_same_tags(again.volume(daughters[0].volume).auxiliaries,
                   detector.volume(brick).auxiliaries);
  expect_same_traces(*detector.model(), *again.model());
}

TEST_F(GdmlWriter, WritesNoBracketsInNamesOfPlacements) {
  const std::string inner = "<volume name='V[1]'><solidref ref='b'/></volume>";
  const Detector detector = read_gdml(
      write("named.gdml", Gdml{.structure = inner + volume("W",
                                                           "<physvol name='PMT[left]'><volumeref "
                                                           "ref='V[1]'/></physvol>" +
                                                               physvol("V[1]"))}));
  const Detector again = read_back(detector);
  const auto& daughters = again.volume(again.world_volume()).daughters;
  ASSERT_EQ(daughters.size(), 2U);
  EXPECT_EQ(daughters[0].name, "PMT(left)");
  EXPECT_EQ(daughters[1].name, "V(1)_PV");
  EXPECT_EQ(again.volume(daughters[1].volume).name, "V[1]");
}

TEST_F(GdmlWriter, WritesExtrudedSolidsThatLeanFar) {
  const std::string polygon =
      "<twoDimVertex x='30' y='90'/><twoDimVertex x='10' y='50'/><twoDimVertex x='20' y='40'/>";
  for (const char* far : {"1e3", "5e4", "2e5"}) {
    const std::string offset(far);
    const Detector detector = read_gdml(write(
        "leans.gdml",
        Gdml{.solids = "<box name='w' x='4*" + offset + "' y='1e3' z='1e3'/><xtru name='s'>" +
                       polygon + "<section zOrder='1' zPosition='0' xOffset='-" + offset +
                       "' yOffset='3' scalingFactor='3'/><section zOrder='2' zPosition='50' "
                       "xOffset='" +
                       offset + "' yOffset='5' scalingFactor='1'/></xtru>",
             .structure = "<volume name='V'><solidref ref='s'/></volume><volume name='W'><solidref "
                          "ref='w'/><physvol><volumeref ref='V'/></physvol></volume>"}));
    const Detector again = read_back(detector);
    const auto solid = [](const Detector& d) {
      return d.volume(d.volume(d.world_volume()).daughters[0].volume).solid;
    };
    EXPECT_NEAR(capacity(solid(again)) / capacity(solid(detector)), 1, 1e-6) << far;
  }
}

TEST_F(GdmlWriter, WritesReflections) {
  DetectorBuilder builder;
  const auto air = builder.material({.name = "air", .density = 0.001});
  const auto hall = builder.volume("hall", make_box("hall", 50, 50, 50), air);
  const auto odd = builder.volume("odd", make_trd("odd", 1, 9, 3, 5, 7), air);
  double turned[9];
  rotation_from_angles(0.4, -0.8, 2.1, turned);
  for (int i = 3; i < 6; ++i) turned[i] = -turned[i];
  builder.place(odd, hall, make_transformation({10, -4, 3}, turned));
  const Detector detector = builder.build(hall);
  const Detector again = read_back(detector);
  expect_same_tree(detector, again);
  expect_same_traces(*detector.model(), *again.model());
}

TEST_F(GdmlWriter, WritesMirroredOperands) {
  SolidFrame mirrored;
  rotation_from_angles(0.4, -0.8, 2.1, mirrored.rotation);
  for (int i = 3; i < 6; ++i) mirrored.rotation[i] = -mirrored.rotation[i];
  mirrored.translation[0] = 12;
  const Solid wedge = make_tube("wedge", 0, 20, 10, 0, 1), box = make_box("box", 8, 6, 4);
  const Solid placed = make_placed("placed", wedge, mirrored);
  for (const Solid& solid :
       {make_union("u", box, placed), make_union("v", placed, box),
        make_subtraction("s", placed, box), make_intersection("i", placed, box), placed}) {
    DetectorBuilder builder;
    const auto air = builder.material({.name = "air", .density = 0.001});
    const auto hall = builder.volume("hall", make_box("hall", 90, 90, 90), air);
    builder.place(builder.volume("odd", solid, air), hall, {});
    const Detector detector = builder.build(hall);
    expect_same_traces(*detector.model(), *read_back(detector).model());
  }
}

TEST_F(GdmlWriter, WritesElementsBeforeWhatRefersToThem) {
  DetectorBuilder builder;
  const auto hydrogen = builder.element({.name = "H", .z = 1, .a = 1.008});
  const auto oxygen = builder.element({.name = "O", .z = 8, .a = 15.999});
  Material water{.name = "Water", .density = 1};
  water.elements = {{hydrogen, 0.112}, {oxygen, 0.888}};
  Material gas{.name = "O", .density = 0.0013};
  gas.elements = {{oxygen, 1}};
  const auto wet = builder.material(water), thin = builder.material(gas);
  const auto hall = builder.volume("hall", make_box("hall", 50, 50, 50), thin);
  builder.place(builder.volume("drop", make_orb("drop", 5), wet), hall, {});
  const Detector detector = builder.build(hall), again = read_back(detector);
  expect_same_tree(detector, again);
  EXPECT_EQ(gdml_text(again), gdml_text(read_back(again)));
}

TEST_F(GdmlWriter, NamesInRegionsAllVolumesOfTheName) {
  World world;
  world.top = tests::add_volume(world, "hall", make_box("hall", 50, 50, 50));
  for (const double x : {-20.0, 20.0}) {
    const VolumeId cell = tests::add_volume(world, "cell", make_box("cell", 5 + x / 10, 5, 5));
    tests::place(world, world.top, cell, {x, 0, 0});
  }
  Auxiliary region{"Region", "inner"};
  region.children.push_back({"volume", "cell"});
  world.auxiliaries = std::make_shared<const std::vector<Auxiliary>>(1, region);
  finish(world);
  const Detector again = read_back(Detector(std::make_shared<const World>(std::move(world))));
  ASSERT_TRUE(again.auxiliaries());
  std::set<std::string> named;
  for (const Auxiliary& child : again.auxiliaries()->at(0).children) named.insert(child.value);
  for (VolumeId v = 0; v < again.volumes(); ++v) {
    const std::string name(again.volume(v).name);
    EXPECT_EQ(named.contains(name), name.starts_with("cell")) << name;
  }
  EXPECT_EQ(named.size(), 2U);
}

}  // namespace
}  // namespace navjit::testing
