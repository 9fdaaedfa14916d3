// Placements: rotation conventions, assemblies, loops.
#include <cmath>
#include <numbers>

#include "tests/geometry/gdml/gdml_files.hpp"

namespace navjit::testing {
namespace {

class GdmlStructure : public GdmlFiles {};

void expect_point(const Vec3& p, double x, double y, double z) {
  EXPECT_NEAR(p.x, x, 1e-12);
  EXPECT_NEAR(p.y, y, 1e-12);
  EXPECT_NEAR(p.z, z, 1e-12);
}

void expect_near(const Transformation& a, const Transformation& b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a.translation[i], b.translation[i], 1e-12);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(a.rotation[i], b.rotation[i], 1e-14);
}

TEST_F(GdmlStructure, RotatesMothersCoordinatesIntoDaughters) {
  const World world = read(
      Gdml{.structure = volume(
               "W", physvol("D", "<position x='1' y='2' z='3'/><rotation x='90' unit='deg'/>") +
                        physvol("D", "<rotation y='90' unit='deg'/>") +
                        physvol("D", "<rotation z='90' unit='deg'/>") +
                        physvol("D", "<rotation x='90' y='90' z='0' unit='deg'/>"))});
  const auto& d = top(world).daughters;
  // Of the mother's axes: Rx(90) takes y to z and z to -y, and so on.
  expect_point(to_local(d[0].transformation, Vec3{1, 7, 3}), 0, 0, 5);
  expect_point(to_local(d[0].transformation, Vec3{1, 2, 8}), 0, -5, 0);
  expect_point(to_local(d[1].transformation, Vec3{1, 0, 0}), 0, 0, -1);
  expect_point(to_local(d[2].transformation, Vec3{1, 0, 0}), 0, 1, 0);
  // First about x, then about y.
  expect_point(to_local(d[3].transformation, Vec3{0, 1, 0}), 1, 0, 0);
  expect_point(to_local(d[3].transformation, Vec3{0, 0, 1}), 0, -1, 0);
  expect_point(to_local(d[3].transformation, Vec3{1, 0, 0}), 0, 0, -1);
  for (const double entry : d[3].transformation.rotation) {
    EXPECT_TRUE(entry == 0 || std::abs(entry) == 1) << entry;
  }
}

TEST_F(GdmlStructure, NamesPlacementsAfterTheirVolumesIfNothingElse) {
  const World world =
      read(Gdml{.structure = volume("W", "<physvol copynumber='7'><volumeref ref='D'/></physvol>" +
                                             physvol("D", "", "named"))});
  EXPECT_EQ(top(world).daughters[0].name, "D_PV");
  EXPECT_EQ(top(world).daughters[0].copy_number, 7);
  EXPECT_EQ(top(world).daughters[1].name, "named");
}

TEST_F(GdmlStructure, DissolvesAssemblies) {
  const std::string outer = "<position x='10' y='20' z='30'/><rotation x='0.3' y='0.2' z='0.1'/>";
  const std::string middle = "<position x='-1' y='2' z='5'/><rotation z='0.5'/>";
  const std::string inner = "<position x='4'/><rotation y='-0.7'/>";
  const World world =
      read(Gdml{.structure = "<assembly name='A'>" + physvol("D", inner, "one") +
                             physvol("D", "", "two") + "</assembly><assembly name='B'>" +
                             physvol("A", middle, "a") + physvol("D", "", "three") + "</assembly>" +
                             volume("W", physvol("B", outer, "b") + physvol("D", "", "last") +
                                             physvol("B"))});
  const auto& d = top(world).daughters;
  ASSERT_EQ(d.size(), 7u);
  EXPECT_EQ(d[0].name, "b.a.one");
  EXPECT_EQ(d[1].name, "b.a.two");
  EXPECT_EQ(d[2].name, "b.three");
  EXPECT_EQ(d[3].name, "last");
  EXPECT_EQ(d[4].name, "B_PV.a.one");
  EXPECT_EQ(world.volumes.size(), 2u) << "assemblies are no volumes";

  // The same with volumes in place of assemblies, a level each.
  const World explicitly =
      read(Gdml{.structure = volume("A", physvol("D", inner)) + volume("B", physvol("A", middle)) +
                             volume("W", physvol("B", outer))});
  const auto& b = top(explicitly).daughters[0];
  const auto& a = explicitly.volumes[b.volume].daughters[0];
  const auto& one = explicitly.volumes[a.volume].daughters[0];
  const Vec3 point{3, -4, 5};
  const Vec3 expected =
      to_local(one.transformation, to_local(a.transformation, to_local(b.transformation, point)));
  expect_point(to_local(d[0].transformation, point), expected.x, expected.y, expected.z);
  const Vec3 local = to_local(a.transformation, to_local(b.transformation, point));
  expect_point(to_local(d[1].transformation, point), local.x, local.y, local.z);
  expect_near(d[2].transformation, b.transformation);
  EXPECT_EQ(d[3].transformation, Transformation{});
}

TEST_F(GdmlStructure, RunsLoopsAsGeant4Does) {
  const World world = read(Gdml{
      .define = "<variable name='i' value='0'/><variable name='j' value='0'/>"
                "<matrix name='shift' coldim='1' values='5 6 7'/>"
                "<loop for='i' from='1' to='2' step='1'><position name='p[i]' x='100*i'/></loop>",
      .solids = "<loop for='i' from='1' to='3' step='1'>"
                "<box name='box[i]' x='i' y='i' z='i'/></loop>",
      .structure = "<loop for='i' from='1' to='3' step='1'><volume name='V[i]'><materialref "
                   "ref='G4_AIR'/><solidref ref='box[i]'/></volume></loop>" +
                   volume("W",
                          "<loop for='i' from='1' to='3' step='2'>"
                          "<loop for='j' from='1' to='2' step='1'>"
                          "<physvol name='cell[i,j]' copynumber='10*i+j'>"
                          "<volumeref ref='V[i]'/><position x='shift[i]' y='j*cm'/></physvol>"
                          "</loop></loop>" +
                              physvol("V_1", "<positionref ref='p_1'/>"))});
  ASSERT_EQ(world.volumes.size(), 5u);
  EXPECT_EQ(world.volumes[1].name, "V_0");
  EXPECT_EQ(world.volumes[3].name, "V_2");
  EXPECT_EQ(world.volumes[3].solid.name, "box_2");
  EXPECT_EQ(world.volumes[3].solid.extent.max.x, 1.5);
  const auto& d = top(world).daughters;
  ASSERT_EQ(d.size(), 5u);
  EXPECT_EQ(d[0].name, "cell_0_0");
  EXPECT_EQ(d[1].name, "cell_0_1");
  EXPECT_EQ(d[3].name, "cell_2_1");
  EXPECT_EQ(d[3].copy_number, 32);
  EXPECT_EQ(d[3].volume, 3u);
  EXPECT_EQ(d[3].transformation.translation[0], 7);
  EXPECT_EQ(d[3].transformation.translation[1], 20);
  EXPECT_EQ(d[4].transformation.translation[0], 200);
}

TEST_F(GdmlStructure, LoopsStartFromTheVariableAndSkipCountingDown) {
  const World world = read(
      Gdml{.define = "<variable name='i' value='3'/>",
           .structure = volume("W", "<loop for='i' to='4' step='1'>" + physvol("D", "", "a[i]") +
                                        "</loop><loop for='i' from='4' to='1' step='-1'>" +
                                        physvol("D", "", "b[i]") + "</loop>")});
  ASSERT_EQ(top(world).daughters.size(), 2u);
  EXPECT_EQ(top(world).daughters[0].name, "a_2");
}

TEST_F(GdmlStructure, RefusesEndlessAndHugeLoops) {
  const auto loop = [&](const std::string& range, const std::string& body = "") {
    return error_of(Gdml{.define = "<variable name='i' value='0'/><constant name='c' value='1'/>",
                         .structure = volume("W", "<loop " + range + ">" + body + "</loop>")});
  };
  EXPECT_HAS(loop("for='i' from='1' to='2' step='0'"),
             "det.gdml:6: <loop for='i'>: the loop never");
  EXPECT_HAS(loop("for='i' from='1' to='1' step='0'"), "the loop never ends");
  EXPECT_HAS(loop("for='i' from='1' to='2' step='-1'"), "the loop never ends");
  EXPECT_HAS(loop("for='i' from='2' to='1' step='1'"), "the loop never ends");
  EXPECT_HAS(loop("for='i' from='1' to='2147483647' step='1'"), "loops process more than 1000000");
  EXPECT_HAS(loop("for='i' from='1' to='1e12' step='1'"), "must be an integer");
  EXPECT_HAS(loop("for='i' from='0.5' to='2' step='1'"), "must be an integer");
  EXPECT_HAS(loop("for='j' from='1' to='2' step='1'"), "variable 'j' is not defined");
  EXPECT_HAS(loop("for='c' from='1' to='2' step='1'"), "variable 'c' is not defined");
  EXPECT_HAS(loop("from='1' to='2' step='1'"), "attribute 'for' is missing");
  EXPECT_HAS(loop("for='i' from='1' step='1'"), "attribute 'to' is missing");
  EXPECT_HAS(loop("for='i' from='1' to='10000' step='1'",
                  "<loop for='i' from='1' to='10000' step='1'></loop>"),
             "loops process more than 1000000");
}

TEST_F(GdmlStructure, BoundsPlacements) {
  GdmlOptions few;
  few.limits.max_placements = 1000;
  std::string doubling = "<assembly name='A0'>" + physvol("D") + "</assembly>";
  for (int i = 1; i < 40; ++i) {
    const std::string last = physvol("A" + std::to_string(i - 1));
    doubling += "<assembly name='A" + std::to_string(i) + "'>" + last + last + "</assembly>";
  }
  EXPECT_HAS(error_of(Gdml{.structure = doubling + volume("W", physvol("A39"))}, few),
             "more than 1000 placements");
  std::string chain = "<assembly name='A0'>" + physvol("D") + "</assembly>";
  for (int i = 1; i < 1000; ++i) {
    chain += "<assembly name='A" + std::to_string(i) + "'>" + physvol("A" + std::to_string(i - 1)) +
             "</assembly>";
  }
  EXPECT_HAS(error_of(Gdml{.structure = chain + volume("W", physvol("A999"))}),
             "assemblies are nested more than 64 deep");
}

TEST_F(GdmlStructure, AcceptsScalesThatKeepSolidsAsTheyAre) {
  const World world =
      read(Gdml{.define = "<scale name='turn' x='-1' y='-1' z='1'/>",
                .structure = volume(
                    "W", physvol("D", "<scale x='1' y='1' z='1'/>") +
                             physvol("D", "<rotation z='0.3'/><scaleref ref='turn'/>") +
                             physvol("D", "<rotation z='" + std::to_string(0.3) + "+pi'/>"))});
  const auto& d = top(world).daughters;
  EXPECT_EQ(d[0].transformation, Transformation{});
  expect_near(d[1].transformation, d[2].transformation);
}

TEST_F(GdmlStructure, NumbersWhatAssembliesHoldAsGeant4Does) {
  GdmlReport report;
  const std::string a = "<assembly name='A'>" + physvol("D") +
                        "<physvol copynumber='90'><volumeref ref='D'/></physvol>" + physvol("D") +
                        "</assembly>";
  const std::string b =
      "<assembly name='B'>" + physvol("A") + physvol("D") + physvol("A") + "</assembly>";
  const World world =
      read(Gdml{.structure =
                    a + b + volume("W", physvol("D") + physvol("A") + physvol("A") + physvol("B"))},
           &report);
  std::vector<int> numbers;
  for (const Placement& d : top(world).daughters) numbers.push_back(d.copy_number);
  // B holds A from the number of daughters so far on (7), itself its second part, and A from 200
  // on.
  EXPECT_EQ(numbers, (std::vector<int>{0, 2, 3, 4, 5, 6, 7, 8, 9, 10, 9, 201, 202, 203}));
  EXPECT_TRUE(report.notes.empty()) << "common, and counted alone";
}

TEST_F(GdmlStructure, NotesWhatGeant4LeavesOutOfAssemblies) {
  GdmlReport report;
  const World world =
      read(Gdml{.define = "<variable name='i' value='0'/>",
                .structure = "<assembly name='A'><loop for='i' from='1' to='2' step='1'>" +
                             physvol("D", "<position x='30*i'/>") + "</loop></assembly>" +
                             volume("W", physvol("A"))},
           &report);
  EXPECT_EQ(top(world).daughters.size(), 2U);
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_HAS(report.notes[0], "in an assembly, where Geant4 leaves it out");
}

}  // namespace
}  // namespace navjit::testing
