// What changes no answer is never fatal: the file is read, and a note names the place.
#include <algorithm>

#include "tests/geometry/gdml/gdml_files.hpp"

namespace navjit::testing {
namespace {

class GdmlTolerant : public GdmlFiles {
 protected:
  /// Reads the file, which must have exactly this note: "FILE:" + `note`.
  World noted(const std::string& text, const std::string& note) {
    GdmlReport report;
    World world = read(text, &report);
    EXPECT_EQ(report.notes.size(), 1u) << text;
    if (!report.notes.empty()) {
      EXPECT_HAS(report.notes[0], (folder_ / "det.gdml").string() + ':' + note);
    }
    return world;
  }
  World silent(const std::string& text) {
    GdmlReport report;
    World world = read(text, &report);
    for (const std::string& note : report.notes) ADD_FAILURE() << note;
    return world;
  }
  static std::string with_material(const std::string& material) {
    return "<gdml><define><quantity name='q' value='3'/></define>\n<materials>" + material +
           "</materials><solids><box name='b' x='2' y='2' z='2'/></solids><structure><volume "
           "name='W'>"
           "<materialref ref='M'/><solidref ref='b'/></volume></structure><setup name='s' "
           "version='1'><world ref='W'/></setup></gdml>";
  }
  static std::string lead(const std::string& children) {
    return with_material("\n<material name='M' Z='82'>\n" + children + "</material>");
  }
};

TEST_F(GdmlTolerant, AtomsInGramsPerMol) {
  const World world = silent(lead("<D value='11.35'/><atom unit='g/mol' value='207.2'/>"));
  EXPECT_NEAR(world.materials.back().radiation_length, 5.612, 0.06);
  noted(lead("<D value='11.35'/><atom unit='g/furlong' value='207.2'/>"),
        "4: <atom>: unit: 'g/furlong' is not a unit");
}

TEST_F(GdmlTolerant, PartsOfMaterials) {
  const auto material = [&](const std::string& children, const std::string& note) {
    return noted(lead(children), note).materials.back();
  };
  EXPECT_EQ(material("<D value='heavy'/><atom value='207'/>", "4: <D>: value: unknown name 'heavy'")
                .density,
            0);
  EXPECT_EQ(material("<D value='3' unit='stone'/>", "4: <D>: ").density, 0);
  EXPECT_EQ(
      material("<D value='3' unit='mm'/>", "4: <D>: unit: 'mm' is not a unit of density").density,
      0);
  EXPECT_EQ(material("<D value='-3'/>", "4: <D>: ").density, 0);
  EXPECT_EQ(material("<Dref ref='none'/>", "4: <Dref ref='none'>: quantity 'none' is not defined")
                .density,
            0);
  EXPECT_EQ(material("<T value='20' unit='degC'/><D value='1'/>",
                     "4: <T>: unit: 'degC' is not a unit of "
                     "temperature; use K")
                .temperature,
            293.15);
  EXPECT_EQ(material("<P value='?'/><D value='1'/>", "4: <P>: value: ").pressure, 101325);
  const Material mixed =
      material("<D value='2'/><fraction n='half' ref='M'/>", "4: <fraction ref='M'>: n: ");
  EXPECT_EQ(mixed.density, 2);
  EXPECT_EQ(mixed.radiation_length, 0);
  material("<D value='2'/><fraction n='-1' ref='M'/>",
           "4: <fraction ref='M'>: n: it is negative; left out");
  material(
      "<D value='2'/><fraction n='1'/>",
      "4: <fraction>: attribute 'ref' is missing; name what is meant; left out with <material ");
  noted(with_material("\n<element name='E' Z='one'/><material name='M'/>"),
        "3: <element name='E'>: Z: unknown name 'one'");
  noted(with_material("\n<isotope Z='1'/><material name='M'/>"), "3: <isotope>: it has no name");
}

TEST_F(GdmlTolerant, GarbledElementsOfMatrices) {
  const std::string matrix = "\n<matrix name='m' coldim='2' values='1 2\n3 4..5 6 7'/>";
  noted(Gdml{.define = matrix, .structure = volume("W")},
        "4: <matrix name='m'>: values: '4..5' is not a number");
  // The others are there.
  const auto placed_at = [&](const std::string& x) {
    return Gdml{.define = matrix,
                .structure = volume("W", physvol("D", "<position x='" + x + "'/>"))};
  };
  EXPECT_EQ(top(read(placed_at("m[3,2]"))).daughters[0].transformation.translation[0], 7);
  const std::string message = error_of(placed_at("m[2,2]"));
  EXPECT_HAS(message, ":4: <matrix name='m'>: values: '4..5' is not a number");
  EXPECT_HAS(message, "(needed by ");
  EXPECT_HAS(message, "det.gdml:8: <position>)");
}

TEST_F(GdmlTolerant, EmptyAttributesAreZero) {
  const World world =
      noted(Gdml{.structure = volume("W", "\n" + physvol("D", "<position x='' y='2' z='3'/>"))},
            "7: <position>: x is empty and counts as 0, as in Geant4");
  EXPECT_EQ(top(world).daughters[0].transformation.translation[0], 0);
  EXPECT_EQ(top(world).daughters[0].transformation.translation[1], 2);
  noted(Gdml{.define = "\n<constant name='c' value=' '/>", .structure = volume("W")},
        "4: <constant name='c'>: value is empty");
  noted(Gdml{.structure = volume("W", "\n<physvol copynumber=''><volumeref ref='D'/></physvol>")},
        "7: <physvol>: copynumber is empty");
  noted(Gdml{.define = "\n<quantity name='q' value='1' unit=''/>", .structure = volume("W")},
        "4: <quantity name='q'>: took an empty unit for 1");
}

TEST_F(GdmlTolerant, CopyNumbersThatCannotBeRead) {
  for (const char* number : {"abc", "4294967295", "1/0", "0.5"}) {
    const World world =
        noted(Gdml{.structure = volume("W", "\n<physvol copynumber='" + std::string(number) +
                                                "'><volumeref ref='D'/></physvol>")},
              "7: <physvol>: its copynumber cannot be read: took 0: copynumber: ");
    EXPECT_EQ(top(world).daughters[0].copy_number, 0);
  }
}

TEST_F(GdmlTolerant, NamesOfPlacementsWithBracketsThatHoldNoIndex) {
  for (const std::string name : {"PMT[left]", "a]", "b[", "c[[1]]"}) {
    const World world = noted(
        Gdml{.structure = volume("W", '\n' + physvol("D", "", name))},
        "7: <physvol name='" + name + "'>: kept a name as it is written: what it has in brackets");
    EXPECT_EQ(top(world).daughters[0].name, name);
  }
}

TEST_F(GdmlTolerant, ZeroInAUnitOfAnotherKind) {
  const auto placed = [](const std::string& frame) {
    return Gdml{.structure = volume("W", '\n' + physvol("D", frame))};
  };
  const std::string note = "its unit is of another kind: took zero";
  const World turned = noted(placed("<rotation z='0' unit='mm'/>"), "7: <rotation>: " + note);
  EXPECT_FALSE(top(turned).daughters[0].transformation.rotated);
  const World moved = noted(placed("<position x='0' unit='furlong'/>"), "7: <position>: " + note);
  EXPECT_FALSE(top(moved).daughters[0].transformation.translation[0] != 0);
  EXPECT_HAS(error_of(placed("<rotation z='1' unit='mm'/>")), "'mm' is not a unit of angle");
}

TEST_F(GdmlTolerant, PolyconesAndPolyhedraWithoutAnOpening) {
  const std::string planes = "><zplane z='-5' rmax='4'/><zplane z='5' rmax='8'/></";
  const std::string contour =
      "><rzpoint r='0' z='-5'/><rzpoint r='8' z='-5'/><rzpoint r='4' z='5'/></";
  const std::pair<std::string, std::string> kinds[] = {{"polycone", planes},
                                                       {"polyhedra numsides='6'", planes},
                                                       {"genericPolycone", contour},
                                                       {"genericPolyhedra numsides='6'", contour}};
  for (const auto& [kind, rest] : kinds) {
    for (const char* delta : {"", " deltaphi='0'", " deltaphi='-1'"}) {
      const std::string tag = kind.substr(0, kind.find(' '));
      const World world =
          noted(Gdml{.solids = "\n<" + kind + " name='s' startphi='1'" + delta + rest + tag + '>',
                     .structure = "<volume name='W'><materialref ref='G4_AIR'/><solidref "
                                  "ref='s'/></volume>"},
                "6: <" + tag + " name='s'>: its deltaphi is missing or not above 0");
      const Solid& s = top(world).solid;
      for (const double x : {-3.0, 3.0}) {
        for (const double y : {-2.0, 2.0}) {
          EXPECT_EQ(kernels::inside(s.any(), Vec3{x, y, 0}, 1e-9), Side::inside) << kind << delta;
        }
      }
    }
  }
}

TEST_F(GdmlTolerant, BrokenDefinitionsOfBrokenDefinitions) {
  std::string chain = "\n<constant name='c0' value='1+'/>";
  for (int i = 1; i <= 1000; ++i) {
    chain +=
        "\n<constant name='c" + std::to_string(i) + "' value='2*c" + std::to_string(i - 1) + "'/>";
  }
  EXPECT_EQ(top(read(Gdml{.define = chain, .structure = volume("W")})).name, "W");
  const std::string message = error_of(
      Gdml{.define = chain, .structure = volume("W", physvol("D", "<position x='c1000'/>"))});
  EXPECT_HAS(message, "det.gdml:4: <constant name='c0'>: value: ");
  EXPECT_LT(message.size(), 1000u);
}

TEST_F(GdmlTolerant, UnusedSolidsAndVolumes) {
  noted(Gdml{.solids = "\n<box name='s' x='-1' y='1' z='1'/>", .structure = volume("W")},
        "6: <box name='s'>: ");
  noted(
      Gdml{.structure = "\n<volume name='V'><solidref ref='nothing'/></volume>" + volume("W")},
      "7: <solidref ref='nothing'>: solid 'nothing' is not defined; define it before its use; left "
      "out with <volume name='V'>");
  GdmlReport report;
  read(Gdml{.solids = "\n<box name='s' x='c' y='1' z='1'/><union name='u'><first ref='b'/><second "
                      "ref='s'/></union>",
            .structure = "<volume name='V'><solidref ref='u'/></volume><assembly name='A'>" +
                         physvol("V") + "</assembly>" + volume("W")},
       &report);
  EXPECT_EQ(report.notes.size(), 4u);
  const std::string message = error_of(
      Gdml{.solids = "\n<box name='s' x='c' y='1' z='1'/><union name='u'><first "
                     "ref='b'/><second ref='s'/></union>",
           .structure = "<volume name='V'><solidref ref='u'/></volume><assembly name='A'>" +
                        physvol("V") + "</assembly>" + volume("W", physvol("A"))});
  EXPECT_HAS(message, "det.gdml:6: <box name='s'>: x: unknown name 'c'");
  EXPECT_HAS(message, "(needed by ");
}

TEST_F(GdmlTolerant, NamelessDefinitions) {
  for (const std::string element :
       {"<position x='1'/>", "<constant value='1'/>", "<matrix coldim='1' values='1'/>",
        "<variable name='' value='1'/>", "<rotation/>", "<quantity value='1'/>"}) {
    noted(Gdml{.define = "\n" + element, .structure = volume("W")},
          "4: <" + element.substr(1, element.find_first_of(" /") - 1));
  }
  noted(Gdml{.solids = "\n<orb r='1'/>", .structure = volume("W")}, "6: <orb>: it has no name");
  noted(Gdml{.structure = "\n<volume><solidref ref='b'/></volume>" + volume("W")},
        "7: <volume>: it has no name");
}

TEST_F(GdmlTolerant, EqualDefinitionsTwice) {
  noted(Gdml{.define = "<constant name='c' value='1'/>\n<constant name='c' value='2/2'/>",
             .structure = volume("W", physvol("D", "<position x='c'/>"))},
        "4: <constant name='c'>: its name is already defined, with the same value");
}

TEST_F(GdmlTolerant, AuxiliariesAnywhere) {
  const std::string auxiliary =
      "<auxiliary auxtype='a' auxvalue='b'><auxiliary auxtype='c'/></auxiliary>";
  EXPECT_EQ(
      top(silent(Gdml{.define = auxiliary,
                      .solids = auxiliary,
                      .structure = auxiliary + volume("W", auxiliary + physvol("D", auxiliary))}))
          .daughters.size(),
      1u);
  silent(Gdml{.solids = "<polycone name='s' deltaphi='7'>" + auxiliary +
                        "<zplane z='0' rmax='1'/><zplane z='1' rmax='1'>" + auxiliary +
                        "</zplane></polycone><union name='u'><first ref='s'/>" + auxiliary +
                        "<second ref='b'/></union>",
              .structure = "<volume name='W'><solidref ref='u'>" + auxiliary +
                           "</solidref><materialref ref='G4_AIR'/></volume>"});
}

TEST_F(GdmlTolerant, LongNames) {
  const std::string name(2444, 'n');
  const World world = silent(
      Gdml{.define = "<constant name='" + name + "' value='4'/>",
           .structure = volume(name) + volume("W", physvol(name, "<position x='" + name + "'/>"))});
  EXPECT_EQ(world.volumes[top(world).daughters[0].volume].name, name);
  EXPECT_EQ(top(world).daughters[0].transformation.translation[0], 4);
}

TEST_F(GdmlTolerant, ManyEntities) {
  std::string doctype = "<!DOCTYPE gdml [";
  for (int i = 0; i < 20'000; ++i) {
    doctype += "<!ENTITY e" + std::to_string(i) + " '" + std::to_string(i) + "'>";
  }
  const World world = silent(Gdml{.structure = volume("W", physvol("D", "<position x='&e17;'/>")),
                                  .doctype = doctype + "]>"});
  EXPECT_EQ(top(world).daughters[0].transformation.translation[0], 17);
}

TEST_F(GdmlTolerant, ModulesSeeTheMaterialsSolidsAndVolumesOfTheirIncluder) {
  const std::string module =
      "<gdml><define><constant name='c' value='2'/></define><materials><material name='mix'><D "
      "value='1'/><fraction n='1' ref='lead'/></material></materials><structure>"
      "<volume name='M'><materialref ref='lead'/><solidref ref='b'/></volume>"
      "<volume name='N'><materialref ref='mix'/><solidref ref='b'/>" +
      physvol("D") +
      "</volume></structure><setup name='s' version='1'><world ref='N'/></setup></gdml>";
  write("module.gdml", module);
  const std::string structure =
      "</structure><materials><element name='Pb' Z='82'><atom value='207.2'/></element><material "
      "name='lead'><D value='11.35'/><fraction n='1' ref='Pb'/></material></materials><structure>" +
      volume("W",
             "<physvol><file name='module.gdml' volname='M'/></physvol><physvol><file "
             "name='module.gdml'/></physvol>");
  const World world = silent(Gdml{.structure = structure});
  const LogicalVolume& m = world.volumes[top(world).daughters[0].volume];
  EXPECT_EQ(world.materials[m.material].name, "lead");
  EXPECT_EQ(m.solid.extent.max.x, 10);
  const LogicalVolume& n = world.volumes[top(world).daughters[1].volume];
  EXPECT_EQ(world.materials[n.material].name, "mix");
  EXPECT_NEAR(world.materials[n.material].radiation_length, 63.7, 0.6);
  EXPECT_EQ(world.volumes[n.daughters[0].volume].name, "D");
  // Names of values do not cross files, in Geant4 neither.
  write("module.gdml",
        "<gdml><structure>" + volume("M", physvol("D", "<position x='outer'/>")) +
            "</structure><setup name='s' version='1'><world ref='M'/></setup></gdml>");
  EXPECT_HAS(
      error_of(Gdml{.define = "<constant name='outer' value='1'/>",
                    .structure = volume("W", "<physvol><file name='module.gdml'/></physvol>")}),
      "unknown name 'outer'");
}

TEST_F(GdmlTolerant, UnitsOfEveryKind) {
  // Each product is 1 in the system of units, whatever that is.
  for (const std::string one : {"newton*meter/joule",
                                "watt*second/joule",
                                "volt*coulomb/joule",
                                "pascal*m3/joule",
                                "farad*volt/coulomb",
                                "ohm*ampere/volt",
                                "siemens*ohm",
                                "S*ohm",
                                "weber/(volt*second)",
                                "henry*ampere/weber",
                                "tesla*m2/weber",
                                "10*kGs/T",
                                "becquerel/hertz",
                                "gray*kg/joule",
                                "Sv/Gy",
                                "lux*m2/lumen",
                                "cd*sr/lm",
                                "MHz*microsecond",
                                "kHz*ms",
                                "1000*mbar/bar",
                                "1000*millibar/bar",
                                "kbar/(1000*bar)",
                                "atm/(101325*Pa)",
                                "N/newton",
                                "kN/(1000*N)",
                                "GW/(1000*MW)",
                                "kW*ms/J",
                                "megajoule/(1000*kJ)",
                                "teraelectronvolt/TeV",
                                "Ci/(37*GBq)",
                                "1000*mCi/Ci",
                                "1000*microcurie/mCi",
                                "1000*milligray/Gy",
                                "amp/A",
                                "1000*mA/A",
                                "1000*nanoampere/microampere",
                                "1000*uF/mF",
                                "1000*pF/nF",
                                "1000*picofarad/nanofarad",
                                "1000*mbarn/barn",
                                "1000*picobarn/nanobarn",
                                "litre/liter",
                                "100*cL/L",
                                "1000*mL/L",
                                "milliliter/cm3",
                                "dioptre*m",
                                "dpt/diopter",
                                "kilovolt/kV",
                                "megavolt/MV",
                                "siemens/S",
                                "candela/cd",
                                "henry/H",
                                "farad/F",
                                "weber/Wb",
                                "lumen/lm",
                                "lux/lx",
                                "gigajoule/GJ",
                                "megawatt/MW",
                                "kilonewton/kN",
                                "microgray*1000000/Gy",
                                "kilogray/(1000*Gy)",
                                "kilobecquerel/kBq",
                                "megabecquerel/MBq",
                                "gigabecquerel/GBq"}) {
    const World world =
        silent(Gdml{.structure = volume("W", physvol("D", "<position x='" + one + "'/>"))});
    EXPECT_NEAR(top(world).daughters[0].transformation.translation[0], 1, 1e-12) << one;
  }
  for (const std::string unit :
       {"MHz", "mbar", "newton", "ohm", "mum", "percent", "perCent", "minute", "day", "eplus",
        "kGy", "mol", "dL", "meter3", "muA", "kG"}) {
    silent(Gdml{.define = "<quantity name='q' value='1' unit='" + unit + "'/>",
                .structure = volume("W")});
  }
  // Geant4 has them where a program adds them to its table.
  for (const std::string unit : {"in", "inch"}) {
    const World world = silent(
        Gdml{.structure = volume("W", physvol("D", "<position x='2' unit='" + unit + "'/>"))});
    EXPECT_DOUBLE_EQ(top(world).daughters[0].transformation.translation[0], 50.8) << unit;
  }
  const World feet =
      silent(Gdml{.define = "<quantity name='q' value='2' unit='ft'/>",
                  .structure = volume("W", physvol("D", "<position x='q' unit='mm'/>"))});
  EXPECT_DOUBLE_EQ(top(feet).daughters[0].transformation.translation[0], 609.6);
  // As names these would hide typing errors.
  EXPECT_HAS(error_of(Gdml{.structure = volume("W", physvol("D", "<position x='2*in'/>"))}),
             "unknown name 'in'");
  EXPECT_HAS(error_of(Gdml{.structure = volume("W", physvol("D", "<position x='day'/>"))}),
             "unknown name 'day'");
}

// As for Geant4: a solid without angles may name any unit of them, angles that are not given are 0.
TEST_F(GdmlTolerant, AnglesThatASolidDoesNotHave) {
  silent(Gdml{
      .solids = "<box name='x' x='2' y='2' z='2' aunit='radiam'/>",
      .structure = "<volume name='W'><materialref ref='G4_AIR'/><solidref ref='x'/></volume>"});
  EXPECT_HAS(error_of(Gdml{.solids = "<tube name='x' rmax='2' z='2' deltaphi='6' aunit='radiam'/>",
                           .structure = "<volume name='W'><materialref ref='G4_AIR'/>"
                                        "<solidref ref='x'/></volume>"}),
             "aunit: 'radiam' is not a unit of angle");
  const World world = silent(Gdml{
      .solids = "<para name='x' x='2' y='4' z='6'/>",
      .structure = "<volume name='W'><materialref ref='G4_AIR'/><solidref ref='x'/></volume>"});
  EXPECT_EQ(top(world).solid.extent.max.y, 2);
}

TEST_F(GdmlTolerant, AWorldThatIsAnAssemblyIsPutInABox) {
  const World world = noted(
      Gdml{.structure = "<assembly name='half'>" + physvol("D", "<position y='30'/>") +
                        "</assembly><assembly name='W'>" + physvol("half", "<position x='-100'/>") +
                        physvol("D", "<position z='500'/>") + "</assembly>"},
      "7: <world ref='W'>: the world is an assembly, which Geant4 refuses: put it in a box");
  EXPECT_EQ(top(world).name, "W");
  EXPECT_EQ(top(world).touchables, 3u);
  EXPECT_EQ(top(world).daughters[0].transformation.translation[0], -100);
  EXPECT_EQ(top(world).daughters[0].transformation.translation[1], 30);
  const Extent& box = top(world).solid.extent;
  EXPECT_GT(box.max.x, 110);
  EXPECT_GT(box.max.y, 40);
  EXPECT_GT(box.max.z, 510);
  EXPECT_LT(box.max.z, 530);
  EXPECT_EQ(box.min.x, -box.max.x);
}

TEST_F(GdmlTolerant, WhatStandsBehindTheEnd) {
  const std::string whole = Gdml{.structure = volume("W", physvol("D"))};
  for (const std::string junk : {"LA", "<gdml/>", "</gdml>", "&nothing;"}) {
    const World world =
        noted(whole + "  \n" + junk, "2: <gdml>: left out what stands behind its end");
    EXPECT_EQ(top(world).daughters.size(), 1u) << junk;
  }
}

}  // namespace
}  // namespace navjit::testing
