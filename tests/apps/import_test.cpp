// `navjit import`.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "navjit/gdml.hpp"
#include "navjit/runtime.hpp"
#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"
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

}  // namespace
}  // namespace navjit
