// Sections, definitions, materials, setups, modules and the report.
#include <algorithm>

#include "tests/geometry/gdml/gdml_files.hpp"

namespace navjit::testing {
namespace {

class GdmlReader : public GdmlFiles {};

TEST_F(GdmlReader, ReadsASmallWorld) {
  const World world = read(Gdml{
      .structure = volume("W0x7f12", physvol("D", "", "first0x1") + physvol("D", "", "second")),
      .world = "W0x7f12"});
  ASSERT_EQ(world.volumes.size(), 2u);
  EXPECT_EQ(top(world).name, "W0x7f12");
  EXPECT_EQ(top(world).solid.kind, SolidKind::box);
  EXPECT_EQ(top(world).solid.extent.max.x, 10);
  ASSERT_EQ(top(world).daughters.size(), 2u);
  EXPECT_EQ(top(world).daughters[0].name, "first0x1");
  EXPECT_FALSE(top(world).daughters[0].transformation.rotated);
  EXPECT_EQ(world.volumes[top(world).daughters[1].volume].name, "D");
  EXPECT_EQ(top(world).touchables, 3u);
  EXPECT_EQ(path_of(world, 2), "W0x7f12/second");
  EXPECT_GT(world.tolerance, 0);
}

TEST_F(GdmlReader, EvaluatesDefinitions) {
  const World world = read(
      Gdml{.define = "<constant name='c' value='2*5'/><quantity name='q' value='3' unit='cm'/>"
                     "<variable name='v' value='q+c'/><expression name='e'>v/2</expression>"
                     "<matrix name='m' coldim='3' values='1 2 3\n 4 5 2*3'/>"
                     "<matrix name='row' coldim='2' values='7 8'/>"
                     "<position name='p' x='c' y='m[2,3]' z='row[2]' unit='cm'/>"
                     "<rotation name='r' z='pi/2'/>",
           .solids = "<box name='s' x='e' y='q' z='m[2,1]' lunit='cm'/>",
           .structure = "<volume name='X'><materialref ref='G4_AIR'/><solidref ref='s'/></volume>" +
                        volume("W", physvol("X", "<positionref ref='p'/><rotationref ref='r'/>"))});
  const Placement& x = top(world).daughters[0];
  const Extent& e = world.volumes[x.volume].solid.extent;
  EXPECT_EQ(e.max.x, 100);  // half of (30 + 10) / 2 cm
  EXPECT_EQ(e.max.y, 150);  // a quantity is in mm; the box then reads it as cm, as in Geant4
  EXPECT_EQ(e.max.z, 20);
  EXPECT_EQ(x.transformation.translation[0], 100);
  EXPECT_EQ(x.transformation.translation[1], 60);
  EXPECT_EQ(x.transformation.translation[2], 80);
  const double expected[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  for (int i = 0; i < 9; ++i) EXPECT_EQ(x.transformation.rotation[i], expected[i]) << i;
}

TEST_F(GdmlReader, TakesMissingUnitsAsMillimetresAndRadians) {
  const World world =
      read(Gdml{.structure = volume("W", physvol("D", "<position x='1'/>") +
                                             physvol("D", "<position x='1' unit='m'/>") +
                                             physvol("D", "<rotation x='pi'/>") +
                                             physvol("D", "<rotation x='180' unit='deg'/>"))});
  const auto& d = top(world).daughters;
  EXPECT_EQ(d[0].transformation.translation[0], 1);
  EXPECT_EQ(d[1].transformation.translation[0], 1000);
  EXPECT_EQ(d[2].transformation, d[3].transformation);
  EXPECT_EQ(d[2].transformation.rotation[4], -1);
}

TEST_F(GdmlReader, KeepsMaterials) {
  const World world = read(
      "<gdml><define><quantity name='rho' value='7' unit='g/cm3'/></define><materials>"
      "<isotope name='i' N='1' Z='1'/><element name='H'/>"
      "<material name='Lead0x1' Z='82'><D value='11.35'/></material>"
      "<material name='Gas'><D value='1.2' unit='kg/m3'/><fraction n='1' ref='H'/></material>"
      "<material name='Iron'><Dref ref='rho'/></material></materials>"
      "<solids><box name='b' x='2' y='2' z='2'/></solids><structure>"
      "<volume name='A'><materialref ref='Gas'/><solidref ref='b'/></volume>"
      "<volume name='B'><materialref ref='G4_Si'/><solidref ref='b'/></volume>"
      "<volume name='C'><materialref ref='Iron'/><solidref ref='b'/></volume>"
      "<volume name='W'><solidref ref='b'/><materialref ref='Lead0x1'/></volume>"
      "</structure><setup name='s' version='1'><world ref='W'/></setup></gdml>");
  const auto material = [&](VolumeId id) { return world.materials[world.volumes[id].material]; };
  EXPECT_EQ(material(0).name, "Gas");
  EXPECT_DOUBLE_EQ(material(0).density, 1.2e-3);
  EXPECT_EQ(material(1).name, "G4_Si");
  EXPECT_EQ(material(1).density, 0);
  EXPECT_EQ(material(2).density, 7);
  EXPECT_EQ(material(3).name, "Lead0x1");
  EXPECT_EQ(material(3).density, 11.35);
}

TEST_F(GdmlReader, LoopsAndDefinitionsInEverySection) {
  GdmlReport report;
  const World world = read(
      "<gdml><userinfo><auxiliary auxtype='a' auxvalue='b'><auxiliary auxtype='c'/></auxiliary>"
      "</userinfo><define><variable name='i' value='0'/><loop for='i' from='1' to='2' step='1'>"
      "<constant name='c[i]' value='10*i'/></loop></define><materials><define><constant name='d' "
      "value='2'/></define><property name='p' ref='m'/><loop for='i' from='1' to='2' step='1'>"
      "<material name='M[i]' Z='i'><MEE value='78' unit='eV'/><property name='RINDEX' ref='m'/><D "
      "value='d*i'/><atom value='1'/></material></loop></materials><solids><define><position "
      "name='p' x='5'/></define><box name='w' x='99' y='99' z='99'/><loop for='i' from='1' to='2' "
      "step='1'><opticalsurface name='o[i]'><property name='R' ref='m'/></opticalsurface><box "
      "name='b[i]' x='c[i]' y='1' z='1'/></loop></solids><structure><loop for='i' from='1' to='2' "
      "step='1'><volume name='V[i]'><materialref ref='M[i]'/><solidref ref='b[i]'/></volume></loop>"
      "<volume name='W'><materialref ref='M_0'/><solidref ref='w'/><loop for='i' from='1' to='2' "
      "step='1'><auxiliary auxtype='x'/><physvol><volumeref ref='V[i]'/><position y='i*20'/>"
      "</physvol></loop></volume></structure><setup name='s' version='1'><world ref='W'/></setup>"
      "<extension/></gdml>",
      &report);
  ASSERT_EQ(top(world).daughters.size(), 2u);
  const LogicalVolume& second = world.volumes[top(world).daughters[1].volume];
  EXPECT_EQ(second.name, "V_1");
  EXPECT_EQ(second.solid.extent.max.x, 10);
  EXPECT_EQ(world.materials[second.material].density, 4);
  std::string notes;
  for (const std::string& note : report.skipped) notes += note + '\n';
  for (const char* note :
       {"skipped <extension> (1)", "skipped <opticalsurface> (2)",
        "skipped <property> in <materials> (1)", "skipped <auxiliary> in <loop> (2)"}) {
    EXPECT_HAS(notes, note);
  }
}

TEST_F(GdmlReader, ChoosesTheSetup) {
  const std::string start = "<gdml><solids><box name='b' x='2' y='2' z='2'/></solids><structure>" +
                            volume("A") + volume("B") + "</structure>";
  const auto setup = [](const std::string& name, const std::string& world) {
    return "<setup name='" + name + "' version='1'><world ref='" + world + "'/></setup>";
  };
  EXPECT_EQ(top(read(start + setup("only", "B") + "</gdml>")).name, "B");
  EXPECT_EQ(top(read(start + setup("x", "A") + setup("Default", "B") + "</gdml>")).name, "B");
  const auto path = write("det.gdml", start + setup("x", "A") + setup("y", "B") + "</gdml>");
  EXPECT_EQ(top(read_world(path)).name, "A");
  EXPECT_EQ(top(read_world(path, {.setup = "y"})).name, "B");
  EXPECT_HAS(error(path, {.setup = "z"}), "setup 'z' is not defined; choose one of 'x', 'y'");
}

TEST_F(GdmlReader, ReadsModules) {
  write("parts/module.gdml", Gdml{.define = "<constant name='c' value='6'/>",
                                  .solids = "<box name='s' x='c' y='c' z='c'/>",
                                  .structure = "<volume name='M'><materialref ref='G4_AIR'/>"
                                               "<solidref ref='s'/></volume>" +
                                               volume("W", physvol("M", "", "in_module"))});
  const auto module = [](const std::string& attributes, const std::string& rest = "") {
    return "<physvol><file name='parts/module.gdml'" + attributes + "/>" + rest + "</physvol>";
  };
  // Names do not cross files: both have a constant c, a box b and volumes D and W.
  const World world =
      read(Gdml{.define = "<constant name='c' value='1'/>",
                .structure = volume("W", module("") + module(" volname='M'", "<position x='c'/>") +
                                             module("") + physvol("D"))});
  const auto& d = top(world).daughters;
  ASSERT_EQ(d.size(), 4u);
  EXPECT_EQ(world.volumes[d[0].volume].name, "W");
  EXPECT_NE(d[0].volume, world.top);
  EXPECT_EQ(d[0].name, "W_PV");
  EXPECT_EQ(world.volumes[d[1].volume].name, "M");
  EXPECT_EQ(world.volumes[d[1].volume].solid.extent.max.x, 3);
  EXPECT_EQ(d[1].transformation.translation[0], 1);
  EXPECT_EQ(d[2].volume, d[0].volume) << "a module is read once";
  EXPECT_EQ(top(world).touchables, 7u);
}

// Geant4 is started in the folder of the main file, and looks nowhere else.
TEST_F(GdmlReader, ModulesOfModulesAreNamedFromTheMainFile) {
  write("parts/wheel/spoke.gdml", Gdml{.structure = volume("W")});
  write("parts/wheel/wheel.gdml",
        Gdml{.structure = volume("W", "<physvol><file name='parts/wheel/spoke.gdml'/></physvol>") +
                          volume("V", "<physvol><file name='spoke.gdml'/></physvol>")});
  const World world = read(
      Gdml{.structure = volume("W", "<physvol><file name='parts/wheel/wheel.gdml'/></physvol>")});
  EXPECT_EQ(top(world).touchables, 3u);
}

// Many projects keep their files in a folder, and start Geant4 in the folder above.
TEST_F(GdmlReader, ModulesMayBeNamedFromAFolderAboveTheMainFile) {
  write("project/geometry/parts/spoke.gdml", Gdml{.structure = volume("W")});
  const auto main =
      write("project/geometry/detectors/main.gdml",
            Gdml{.structure = volume(
                     "W", "\n<physvol><file name='./geometry/parts/spoke.gdml'/></physvol>")});
  GdmlReport report;
  EXPECT_EQ(top(read_world(main, {}, &report)).touchables, 2u);
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_HAS(report.notes[0], "found the file in a folder above the main file");
  EXPECT_HAS(report.notes[0], "project/geometry/parts/spoke.gdml");
}

TEST_F(GdmlReader, RefusesBadModules) {
  const auto place = [](const std::string& file) {
    return Gdml{.structure = volume("W", "\n<physvol>" + file + "</physvol>")};
  };
  EXPECT_HAS(error_of(place("<file name='det.gdml'/>")), "includes itself");
  write("a.gdml", place("<file name='b.gdml'/>"));
  write("b.gdml", place("<file name='a.gdml'/>"));
  EXPECT_HAS(error(folder_ / "a.gdml"), "b.gdml:7: <file name='a.gdml'>: file '");
  EXPECT_HAS(error_of(place("<file name='none.gdml'/>")),
             "det.gdml:7: <file name='none.gdml'>: there is no such file in the working folder");
  EXPECT_HAS(error_of(place("<file/>")), "attribute 'name' is missing");
  EXPECT_HAS(error_of(place("<file name='http://x/y.gdml'/>")), "is not fetched");
  write("good.gdml", Gdml{.structure = volume("W")});
  EXPECT_HAS(error_of(place("<file name='good.gdml' volname='nothing'/>")),
             "volume 'nothing' is not defined");
  write("bad.gdml", "<gdml/>");
  EXPECT_HAS(error_of(place("<file name='bad.gdml'/>")), "bad.gdml:1: <gdml>: it has no <setup>");
  for (int i = 0; i < 50; ++i) {
    write("m" + std::to_string(i) + ".gdml",
          place("<file name='m" + std::to_string(i + 1) + ".gdml'/>"));
  }
  EXPECT_HAS(error(folder_ / "m0.gdml"), "nested more than");
}

TEST_F(GdmlReader, ReportsWhatItSkips) {
  GdmlReport report;
  read(Gdml{.solids = "<opticalsurface name='o'/>",
            .structure = volume("W") + "<skinsurface name='s'/><bordersurface name='t'/>"},
       &report);
  const auto count = [&](const std::string& note) {
    return std::count(report.skipped.begin(), report.skipped.end(), note);
  };
  EXPECT_EQ(count("skipped <skinsurface> (1)"), 1);
  EXPECT_EQ(count("skipped <bordersurface> (1)"), 1);
  EXPECT_EQ(count("skipped <opticalsurface> (1)"), 1);
}

TEST_F(GdmlReader, UsesTheFirstOfSeveralDefinitions) {
  GdmlReport report;
  const World world = read(Gdml{.solids = "<box name='b' x='2' y='2' z='2'/>",
                                .structure = volume("D") + volume("W", physvol("D"))},
                           &report);
  EXPECT_EQ(top(world).solid.extent.max.x, 10);
  EXPECT_EQ(top(world).daughters[0].volume, 0u);
  EXPECT_EQ(world.volumes.size(), 2u);
  ASSERT_EQ(report.notes.size(), 2u);
  EXPECT_EQ(report.notes[0],
            (folder_ / "det.gdml").string() +
                ":5: <box name='b'>: left out, since the first of several solids of "
                "the same name holds");
  EXPECT_HAS(report.notes[1], ":6: <volume name='D'>: left out");
}

TEST_F(GdmlReader, UnsupportedSolidsMatterOnlyIfUsed) {
  const std::string torus = "<torus name='t' rmin='0' rmax='1' rtor='5' deltaphi='1'/>";
  EXPECT_EQ(top(read(Gdml{.solids = torus, .structure = volume("W")})).name, "W");
}

}  // namespace
}  // namespace navjit::testing
