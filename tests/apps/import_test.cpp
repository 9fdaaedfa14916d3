// `navjit import`.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "navjit/gdml.hpp"
#include "navjit/runtime.hpp"
#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/root_geometry.hpp"
#include "tests/support/surfaces.hpp"

namespace navjit {
namespace {

using tests::run_navjit;

class Import : public testing::Test {
 protected:
  tests::Output import(const std::string& name, const std::string& bytes,
                       const std::string& options = "") {
    tests::write_file(folder_.file(name), bytes);
    return run_navjit("import " + folder_.file(name) + " -o " + out_ + " " + options);
  }
  tests::TemporaryFolder folder_;
  std::string out_ = folder_.file("out.gdml");
};

TEST_F(Import, MakesADetectorOfTheBody) {
  const tests::Mesh mesh = tests::ball(3);
  const Solid body = make_tessellated("ball", mesh);
  const std::string formats[] = {tests::binary_stl(mesh), tests::ascii_stl(mesh), tests::obj(mesh)};
  for (int format = 0; format < 3; ++format) {
    const tests::Output output =
        import(format < 2 ? "ball.stl" : "ball.obj", formats[format], "--unit cm --material Lead");
    ASSERT_EQ(output.status, 0) << output.text;
    const Detector detector = read_gdml(out_);
    const LogicalVolume& volume = detector.volume(*detector.find_volume("ball"));
    EXPECT_EQ(detector.material(volume).name, "Lead");
    EXPECT_NEAR(detector.material(volume).radiation_length, 5.61, 0.05);
    EXPECT_EQ(detector.material(detector.volume(detector.world_volume())).name, "Air");
    EXPECT_NEAR(capacity(volume.solid), 1000 * capacity(body), 1e-2 * capacity(body));
    // The volume by points of the world, and each point beside the solid itself.
    Runtime runtime{detector, {.jit = JitMode::off}};
    Navigator navigator = runtime.navigator();
    const Extent& e = detector.volume(detector.world_volume()).solid.extent;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> x(e.min.x, e.max.x), y(e.min.y, e.max.y),
        z(e.min.z, e.max.z);
    const double all = (e.max.x - e.min.x) * (e.max.y - e.min.y) * (e.max.z - e.min.z);
    const int points = 40000;
    int inside = 0;
    for (int i = 0; i < points; ++i) {
      const Vec3 point{x(random), y(random), z(random)};
      const State state = navigator.locate(point);
      ASSERT_TRUE(state.inside());
      const bool within = detector.depth(state) == 1;
      inside += within ? 1 : 0;
      // Within the dented ball of 6 to 10 cm.
      EXPECT_TRUE(within || norm(point) >= 55);
      EXPECT_FALSE(within && norm(point) > 101);
    }
    const double share = capacity(volume.solid) / all;
    EXPECT_NEAR(static_cast<double>(inside) / points, share,
                5 * std::sqrt(share * (1 - share) / points));
  }
}

TEST_F(Import, MaterialsAreKnownOrGiven) {
  const std::string block = tests::binary_stl(tests::block());
  ASSERT_EQ(import("block.stl", block, "--material Alumina --density 3.97 --formula Al2O3").status,
            0);
  Detector detector = read_gdml(out_);
  const Material& alumina = detector.material(detector.volume(*detector.find_volume("block")));
  EXPECT_EQ(alumina.density, 3.97);
  ASSERT_EQ(alumina.elements.size(), 2U);
  EXPECT_NEAR(alumina.radiation_length, 70.38, 0.5);

  ASSERT_EQ(import("block.stl", block, "--material G4_Fe --world Vacuum --name 'a plate'").status,
            0);
  detector = read_gdml(out_);
  EXPECT_EQ(detector.material(detector.volume(*detector.find_volume("a plate"))).name, "G4_Fe");
  EXPECT_NE(tests::read_file(out_).find("\"G4_Fe\""), std::string::npos);

  // The same for both.
  ASSERT_EQ(import("block.stl", block, "--material Air").status, 0);
  EXPECT_EQ(read_gdml(out_).materials(), 1U);

  for (const char* wrong :
       {"--material Unobtainium", "--material X --density 2", "--material X --formula Al",
        "--material X --density 2 --formula Xy", "--formula Al0", "--formula 2Al"}) {
    const tests::Output output = import("block.stl", block, wrong);
    EXPECT_EQ(output.status, 1) << wrong;
    EXPECT_TRUE(output.text.starts_with("navjit: ")) << output.text;
  }
  for (const char* wrong : {"--unit parsec", "--density 0", "--density nan"}) {
    EXPECT_EQ(import("block.stl", block, wrong).status, 2) << wrong;
  }
}

TEST_F(Import, WhatIsOpenIsRefusedAndWritesNothing) {
  tests::Mesh mesh = tests::block();
  mesh.pop_back();
  const tests::Output output = import("open.stl", tests::ascii_stl(mesh));
  EXPECT_EQ(output.status, 1);
  EXPECT_TRUE(output.text.starts_with("navjit: " + folder_.file("open.stl") + ": it is open"))
      << output.text;
  EXPECT_FALSE(std::filesystem::exists(out_));
  EXPECT_EQ(run_navjit("import " + folder_.file("none.stl") + " -o " + out_).status, 1);
}

tests::RootPointer root_detector(const std::string& name) {
  const auto leaf = tests::root_volume(name, tests::root_box("leafbox", 1, 2, 3));
  return tests::root_manager(tests::root_volume(
      "world", tests::root_box("hall", 50, 50, 50),
      {tests::root_node("leaf_1", leaf, 7, tests::root_translation(-5, 0, 0)),
       tests::root_node("leaf_2", leaf, 8,
                        tests::root_placed(5, 0, 0, {0, -1, 0, 1, 0, 0, 0, 0, -1}))}));
}

TEST_F(Import, WritesRootGeometriesAsGdml) {
  const std::string bytes =
      tests::root_file({{"first", root_detector("one")}, {"second", root_detector("two")}},
                       tests::RootPacking::zlib);
  // Whatever the file is called.
  const tests::Output output = import("detector.dat", bytes);
  ASSERT_EQ(output.status, 0) << output.text;
  const Detector detector = read_gdml(out_);
  EXPECT_EQ(detector.touchables(), 3U);
  const LogicalVolume& world = detector.volume(detector.world_volume());
  EXPECT_EQ(world.daughters.at(1).copy_number, 8);
  EXPECT_EQ(world.daughters.at(1).transformation.translation[0], 50);
  EXPECT_EQ(detector.material(world).name, "Lead");

  ASSERT_EQ(import("detector.root", bytes, "--setup second").status, 0);
  EXPECT_TRUE(read_gdml(out_).find_volume("two"));
  EXPECT_EQ(import("detector.root", bytes, "--setup third").status, 1);
  EXPECT_EQ(import("detector.root", bytes, "--unit cm").status, 1);
  EXPECT_EQ(import("block.stl", tests::binary_stl(tests::block()), "--setup first").status, 1);
  const tests::Output none = import("none.root", "version https://git-lfs.github.com/spec/v1\n");
  EXPECT_EQ(none.status, 1);
  EXPECT_NE(none.text.find("it is a Git LFS pointer"), std::string::npos) << none.text;
}

TEST_F(Import, RootGeometriesAreReadByEveryCommandAsTheirGdmlIs) {
  const std::string root = folder_.file("detector.root");
  ASSERT_EQ(import("detector.root", tests::root_file({{"g", root_detector("leaf")}})).status, 0);
  for (const std::string command : {"trace --rays 500", "check", "inspect"}) {
    const std::size_t word = command.find(' ');
    const std::string verb = command.substr(0, word);
    const std::string options = word == std::string::npos ? "" : command.substr(word);
    const tests::Output from_root = run_navjit(verb + " " + root + options);
    const tests::Output from_gdml = run_navjit(verb + " " + out_ + options);
    EXPECT_EQ(from_root.status, 0) << from_root.text;
    // `inspect` begins with the file's name.
    const auto after_name = [&](const tests::Output& o) {
      return o.text.substr(o.text.find('\n'));
    };
    EXPECT_EQ(after_name(from_root), after_name(from_gdml)) << command;
  }
  const tests::Output run = run_navjit("run " + root + " --rays 1000 --jit off");
  EXPECT_EQ(run.status, 0) << run.text;
}

}  // namespace
}  // namespace navjit
