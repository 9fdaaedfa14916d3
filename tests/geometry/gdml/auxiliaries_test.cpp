// <auxiliary> tags are kept unchanged for the program that reads the file.
#include "tests/geometry/gdml/gdml_files.hpp"

namespace navjit::testing {
namespace {

std::string tag(const std::string& type, const std::string& value, const std::string& inner = "") {
  return "<auxiliary auxtype='" + type + "' auxvalue='" + value + "'>" + inner + "</auxiliary>";
}

using GdmlAuxiliaries = GdmlFiles;

TEST_F(GdmlAuxiliaries, OfVolumesPlacementsAndFiles) {
  GdmlReport report;
  const World world = read(
      Gdml{.structure = "<volume name='V'>" + tag("SensDet", "Calo") +
                        "<solidref ref='b'/><auxiliary auxtype='StepLimit' auxvalue='2' "
                        "auxunit='mm'>" +
                        tag("a", "1") + tag("b", "2", tag("c", "3")) + "</auxiliary></volume>" +
                        volume("W", physvol("V", tag("Copy", "first")) + physvol("V")) +
                        "</structure><userinfo>" + tag("file", "x") + "</userinfo><structure>"},
      &report);
  EXPECT_TRUE(report.skipped.empty() || report.skipped[0].find("auxiliary") == std::string::npos);
  const Placement &first = top(world).daughters[0], &second = top(world).daughters[1];
  const LogicalVolume& v = world.volumes[first.volume];
  ASSERT_TRUE(v.auxiliaries);
  ASSERT_EQ(v.auxiliaries->size(), 2u);
  EXPECT_EQ(v.auxiliaries->at(0).type, "SensDet");
  EXPECT_EQ(v.auxiliaries->at(0).value, "Calo");
  EXPECT_EQ(v.auxiliaries->at(1).unit, "mm");
  ASSERT_EQ(v.auxiliaries->at(1).children.size(), 2u);
  EXPECT_EQ(v.auxiliaries->at(1).children[1].children.at(0).value, "3");
  ASSERT_TRUE(first.auxiliaries);
  EXPECT_EQ(first.auxiliaries->at(0).value, "first");
  EXPECT_FALSE(second.auxiliaries);
  EXPECT_FALSE(top(world).auxiliaries);
  ASSERT_TRUE(world.auxiliaries);
  EXPECT_EQ(world.auxiliaries->at(0).type, "file");
}

TEST_F(GdmlAuxiliaries, OfCopiesAndImprints) {
  const World world = read(Gdml{
      .define = "<variable name='i' value='0'/>",
      .solids = "<box name='slice' x='1' y='20' z='20'/>",
      .structure = "<volume name='S'><solidref ref='slice'/>" + tag("SensDet", "S") +
                   "</volume><volume name='M'><solidref ref='b'/><divisionvol axis='kXAxis' "
                   "number='4' unit='mm'><volumeref ref='S'/></divisionvol></volume><assembly "
                   "name='A'>" +
                   physvol("M", tag("Side", "left")) + "</assembly>" +
                   volume("W", physvol("A") +
                                   "<loop for='i' from='1' to='2' step='1'><physvol><volumeref "
                                   "ref='M'/>" +
                                   tag("Side", "right") + "</physvol></loop>")});
  const auto& daughters = top(world).daughters;
  ASSERT_EQ(daughters.size(), 3u);
  EXPECT_EQ(daughters[0].auxiliaries->at(0).value, "left");
  EXPECT_EQ(daughters[1].auxiliaries->at(0).value, "right");
  EXPECT_EQ(daughters[1].auxiliaries, daughters[2].auxiliaries) << "kept once";
  const LogicalVolume& m = world.volumes[daughters[0].volume];
  const LogicalVolume& slice = world.volumes[m.daughters[0].volume];
  EXPECT_EQ(slice.solid.extent.max.x, 2.5);
  EXPECT_EQ(slice.auxiliaries->at(0).value, "S");
}

TEST_F(GdmlAuxiliaries, ManyInLoopsAreKeptOnce) {
  // A megabyte of text for each of 100,000 volumes.
  const World world = read(
      Gdml{.define = "<variable name='i' value='0'/>",
           .structure = "<loop for='i' from='1' to='100000' step='1'><volume name='V[i]'><solidref "
                        "ref='b'/>" +
                        tag("long", std::string(1 << 20, 'x')) + "</volume></loop>" +
                        volume("W", physvol("V_98"))});
  EXPECT_EQ(world.volumes[top(world).daughters[0].volume].auxiliaries->at(0).value.size(),
            1u << 20);
}

}  // namespace
}  // namespace navjit::testing
