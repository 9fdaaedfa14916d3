// Files made to exhaust memory or time are refused in one line, before they do so.
#include "tests/geometry/gdml/gdml_files.hpp"

namespace navjit::testing {
namespace {

std::string repeated(const std::string& text, int times) {
  std::string all;
  all.reserve(text.size() * static_cast<std::size_t>(times));
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

class GdmlHostile : public GdmlFiles {
 protected:
  void expect_refused(const std::string& text, const std::string& problem,
                      const GdmlOptions& options = {}) {
    const std::string message = error_of(text, options);
    EXPECT_HAS(message, problem);
    EXPECT_LACKS(message, "\n");
    EXPECT_LT(message.size(), 2000u);
  }
  static std::string in_world(const std::string& daughters, const std::string& solids = "",
                              const std::string& define = "") {
    return Gdml{.define = define, .solids = solids, .structure = volume("W", daughters)};
  }
};

TEST_F(GdmlHostile, EntityBombs) {
  std::string doctype = "<!DOCTYPE gdml [<!ENTITY e0 'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa'>";
  for (int i = 1; i < 12; ++i) {
    doctype += "<!ENTITY e" + std::to_string(i) + " '" +
               repeated("&e" + std::to_string(i - 1) + ";", 10) + "'>";
  }
  expect_refused(Gdml{.define = "<expression name='x'>&e11;</expression>",
                      .structure = volume("W"),
                      .doctype = doctype + "]>"},
                 "not well-formed XML");
  expect_refused(Gdml{.define = "&a;",
                      .structure = volume("W"),
                      .doctype = "<!DOCTYPE gdml [<!ENTITY a '&b;'><!ENTITY b '&a;'>]>"},
                 "not well-formed XML: recursive");
  expect_refused(Gdml{.define = "&a;",
                      .structure = volume("W"),
                      .doctype = "<!DOCTYPE gdml [<!ENTITY a SYSTEM 'det.gdml'>]>"},
                 "det.gdml");
}

TEST_F(GdmlHostile, Nesting) {
  expect_refused(repeated("<gdml>", 1'000'000), "nested more than 1000 deep");
  expect_refused(
      in_world(repeated("<loop for='i' from='1' to='1' step='1'>", 900) + repeated("</loop>", 900),
               "", "<variable name='j' value='0'/>"),
      "variable 'i' is not defined");
  const std::string loops = repeated("<loop for='i' from='1' to='1000' step='1'>", 20) +
                            physvol("D") + repeated("</loop>", 20);
  expect_refused(in_world(loops, "", "<variable name='i' value='0'/>"), "loops process more than");
}

TEST_F(GdmlHostile, ChainsOfBooleans) {
  std::string chain = "<box name='u0' x='1' y='1' z='1'/>";
  for (int i = 1; i <= 100'000; ++i) {
    const std::string number = std::to_string(i), last = std::to_string(i - 1);
    chain += "<union name='u" + number + "'><first ref='u" + last + "'/><second ref='b'/></union>";
  }
  expect_refused(in_world("", chain), "more than 1000 booleans are chained");
  // A million of them, in a loop.
  expect_refused(
      in_world("",
               "<box name='u_0' x='1' y='1' z='1'/><loop for='i' from='2' to='1000000' step='1'>"
               "<union name='u[i]'><first ref='u[i-1]'/><second ref='b'/></union></loop>",
               "<variable name='i' value='0'/>"),
      "more than 1000 booleans are chained");
  // Many chains of one that is large.
  std::string many = "<box name='u0' x='1' y='1' z='1'/>";
  for (int i = 1; i <= 13; ++i) {
    const std::string last = "ref='u" + std::to_string(i - 1) + "'/>";
    many +=
        "<union name='u" + std::to_string(i) + "'><first " + last + "<second " + last + "</union>";
  }
  for (int i = 0; i < 100'000; ++i) {
    many += "<union name='m" + std::to_string(i) + "'><first ref='u13'/><second ref='b'/></union>";
  }
  expect_refused(in_world("", many), "too many parts in all");
  std::string scaled = "<box name='u0' x='1' y='1' z='1'/>";
  for (int i = 1; i <= 300; ++i) {
    scaled += "<scaledSolid name='u" + std::to_string(i) + "'><solidref ref='u" +
              std::to_string(i - 1) + "'/><scale x='2'/></scaledSolid>";
  }
  expect_refused(in_world("", scaled), "deep");
}

TEST_F(GdmlHostile, CyclicReferences) {
  expect_refused(in_world(physvol("W")), "volume 'W' contains itself");
  expect_refused(in_world("", "<union name='u'><first ref='u'/><second ref='b'/></union>"),
                 "solid 'u' contains itself");
  expect_refused(
      in_world("<physvol><file name='" + (folder_ / "det.gdml").string() + "'/></physvol>"),
      "includes itself");
  expect_refused(in_world(physvol("D", "<position x='a'/>"), "",
                          "<constant name='a' value='b'/><constant name='b' value='a'/>"),
                 "unknown name 'b'");
  expect_refused(
      in_world("<divisionvol axis='kXAxis' number='2'><volumeref ref='W'/></divisionvol>"),
      "volume 'W' contains itself");
  expect_refused(in_world("<paramvol><volumeref ref='W'/></paramvol>"),
                 "volume 'W' contains itself");
}

TEST_F(GdmlHostile, CyclesOfModules) {
  const auto includes = [&](const std::string& name) {
    return in_world("<physvol><file name='" + (folder_ / name).string() + "'/></physvol>");
  };
  write("other.gdml", includes("det.gdml"));
  expect_refused(includes("other.gdml"), "includes itself");
}

TEST_F(GdmlHostile, LongNamesInLoops) {
  GdmlOptions options;
  options.limits.max_loop_iterations = 10'000;
  expect_refused(in_world("",
                          "<loop for='i' from='1' to='4000' step='1'><orb name='" +
                              std::string(2000, 'n') + "[i]' r='1'/></loop>",
                          "<variable name='i' value='0'/>"),
                 "loops make too long names", options);
}

TEST_F(GdmlHostile, DefinitionsThatCannotBeRead) {
  expect_refused(in_world("", "", repeated("<constant name='c' value='1+'/>", 20'000)),
                 "more than 10000 definitions cannot be read");
}

TEST_F(GdmlHostile, CountsOfCopies) {
  const auto replicas = [](const std::string& number) {
    return in_world("<replicavol number='" + number +
                    "'><volumeref ref='D'/><replicate_along_axis><direction x='1'/><width "
                    "value='1' unit='mm'/></replicate_along_axis></replicavol>");
  };
  expect_refused(replicas("1000000000000"), "must be an integer");
  expect_refused(replicas("2000000000"), "makes no copies");
  expect_refused(replicas("900000000"), "placements");
  expect_refused(
      in_world("<divisionvol axis='kXAxis' width='1e-8'><volumeref ref='D'/></divisionvol>"),
      "makes no copies");
  expect_refused(
      in_world("<divisionvol axis='kXAxis' width='1e-7'><volumeref ref='D'/></divisionvol>"),
      "placements");
}

TEST_F(GdmlHostile, LoopsWithoutAnEnd) {
  const auto loop = [](const std::string& range) {
    return in_world("<loop for='i' " + range + ">" + physvol("D") + "</loop>", "",
                    "<variable name='i' value='0'/>");
  };
  expect_refused(loop("from='1' to='9' step='1e-9'"), "step: '1e-9' must be an integer");
  expect_refused(loop("from='1' to='9' step='0'"), "never ends");
  expect_refused(loop("from='1' to='9' step='-1'"), "never ends");
  expect_refused(loop("from='1' to='2000000000' step='1'"), "loops process more than");
  expect_refused(loop("from='1' to='1e300' step='1'"), "must be an integer");
}

TEST_F(GdmlHostile, AssembliesOfAssemblies) {
  std::string assemblies = "<assembly name='A0'>" + physvol("D") + "</assembly>";
  for (int i = 1; i < 60; ++i) {
    const std::string inner = physvol("A" + std::to_string(i - 1));
    assemblies += "<assembly name='A" + std::to_string(i) + "'>" + inner + inner + "</assembly>";
  }
  expect_refused(Gdml{.structure = assemblies + volume("W", physvol("A59"))}, "placements");
  // 100 in each, which are placed 100,000 times.
  const std::string many = "<assembly name='A'>" + repeated(physvol("D"), 100) + "</assembly>";
  expect_refused(Gdml{.structure = many + volume("W", repeated(physvol("A"), 100'000))},
                 "placements");
}

TEST_F(GdmlHostile, DaughtersOfCopies) {
  // Every slice has its own shape, and would have its own 1000 daughters.
  const std::string mother = "<cone name='m' rmax1='1' rmax2='9' z='9' deltaphi='7'/>";
  const std::string structure =
      "<volume name='S'><materialref ref='G4_Pb'/><solidref ref='m'/>" +
      repeated(physvol("D"), 1000) +
      "</volume><volume name='W'><materialref ref='G4_Pb'/><solidref ref='m'/><divisionvol "
      "axis='kZAxis' number='100000'><volumeref ref='S'/></divisionvol></volume>";
  expect_refused(Gdml{.solids = mother, .structure = structure}, "placements");
}

TEST_F(GdmlHostile, CopiesOfDifferentShapes) {
  const auto divided = [](const std::string& mother, const std::string& attributes) {
    return Gdml{.solids = mother,
                .structure =
                    "<volume name='S'><materialref ref='G4_Pb'/><solidref ref='m'/></volume>"
                    "<volume name='W'><materialref ref='G4_Pb'/><solidref ref='m'/>"
                    "<divisionvol " +
                    attributes + "><volumeref ref='S'/></divisionvol></volume>"};
  };
  expect_refused(
      divided("<tube name='m' rmax='9' z='9' deltaphi='7'/>", "axis='kRho' number='900000'"),
      "too many copies of different shapes");
  std::string planes;
  for (int i = 0; i < 1000; ++i) planes += "<zplane z='" + std::to_string(i) + "' rmax='9'/>";
  expect_refused(divided("<polycone name='m' deltaphi='7'>" + planes + "</polycone>",
                         "axis='kRho' number='900000'"),
                 "too many copies of different shapes");
}

TEST_F(GdmlHostile, PolygonsOfManyCorners) {
  std::string corners, many;
  for (int i = 0; i < 4000; ++i) {
    corners += "<twoDimVertex x='" + std::to_string(i) + "' y='" + std::to_string(i % 2) + "'/>";
  }
  corners += "<twoDimVertex x='2000' y='5000'/>";
  for (int i = 0; i < 3; ++i) {
    many += "<xtru name='x" + std::to_string(i) + "'>" + corners +
            "<section zOrder='0' zPosition='0'/><section zOrder='1' zPosition='9'/></xtru>";
  }
  GdmlOptions options;
  options.limits.max_elements = 500'000;
  expect_refused(in_world("", many), "too many corners", options);
}

TEST_F(GdmlHostile, Matrices) {
  expect_refused(in_world(physvol("D", "<position x='m[1]'/>"), "",
                          "<matrix name='m' coldim='2147483647' values='1 2 3'/>"),
                 "coldim=2147483647");
  GdmlOptions options;
  options.limits.max_bytes = 1 << 20;
  expect_refused(
      in_world("", "", "<matrix name='m' coldim='1' values='" + repeated("1 ", 1 << 20) + "'/>"),
      "too much text", options);
}

TEST_F(GdmlHostile, MixturesOfMixtures) {
  // Two to the power of 200 parts if they were written out.
  std::string materials =
      "<element name='H' Z='1'><atom value='1'/></element><material name='m0'><D "
      "value='1'/><fraction "
      "n='1' ref='H'/></material>";
  for (int i = 1; i < 200; ++i) {
    const std::string half = "<fraction n='0.5' ref='m" + std::to_string(i - 1) + "'/>";
    materials +=
        "<material name='m" + std::to_string(i) + "'><D value='1'/>" + half + half + "</material>";
  }
  const World world = read(
      "<gdml><materials>" + materials +
      "</materials><solids><box name='b' x='2' y='2' z='2'/></solids><structure><volume name='W'>"
      "<materialref ref='m199'/><solidref ref='b'/></volume></structure><setup name='s' "
      "version='1'><world ref='W'/></setup></gdml>");
  EXPECT_NEAR(world.materials.back().radiation_length, 630, 10);
}

TEST_F(GdmlHostile, NumbersThatAreNone) {
  for (const char* value :
       {"nan", "inf", "1e999", "1/0", "0*1e999", "sqrt(-1)", "1e300", "-1e300", "log(0)"}) {
    for (const char* solid :
         {"<box name='s' x='V' y='1' z='1'/>", "<tube name='s' rmax='V' z='1' deltaphi='1'/>",
          "<sphere name='s' rmax='V' deltaphi='1' deltatheta='1'/>",
          "<torus name='s' rmin='0' rmax='1' rtor='V' deltaphi='1'/>"}) {
      std::string text = solid;
      text.replace(text.find('V'), 1, value);
      EXPECT_LACKS(error_of(Gdml{.solids = text,
                                 .structure = "<volume name='S'><solidref ref='s'/></volume>" +
                                              volume("W", physvol("S"))}),
                   "\n")
          << text;
    }
  }
}

TEST_F(GdmlHostile, ScalesWithoutBounds) {
  const std::string box = "<box name='b' x='60' y='1' z='1'/>";
  for (const char* factor : {"1e-300", "-1e-31", "1e31", "1e300"}) {
    expect_refused(Gdml{.solids = box + "<reflectedSolid name='s' solid='b' sx='48' sy='7' sz='" +
                                  factor + "'/>",
                        .structure = "<volume name='S'><solidref ref='s'/></volume>" +
                                     volume("W", physvol("S"))},
                   "between 1e-30 and 1e30");
  }
  // A solid that is scaled again and again.
  std::string chain = box + "<reflectedSolid name='s0' solid='b' sx='1' sy='1' sz='1e-25'/>";
  for (int i = 1; i < 4; ++i) {
    chain += "<reflectedSolid name='s" + std::to_string(i) + "' solid='s" + std::to_string(i - 1) +
             "' sx='1' sy='1' sz='1e-25'/>";
  }
  expect_refused(Gdml{.solids = chain,
                      .structure = "<volume name='S'><solidref ref='s3'/></volume>" +
                                   volume("W", physvol("S"))},
                 "cannot be navigated");
}

TEST_F(GdmlHostile, LongExpressionsInLoopsAreCounted) {
  std::string longest = "2";
  while (longest.size() < 9000) longest += "^1";
  const std::string loop = "<loop for='i' from='1' to='499999' step='1'><position name='p' x='" +
                           longest + "' y='" + longest + "'/></loop>";
  EXPECT_HAS(
      error_of(Gdml{.define = "<variable name='i' value='0'/>" + loop, .structure = volume("W")}),
      "loops process more than");
}

}  // namespace
}  // namespace navjit::testing
