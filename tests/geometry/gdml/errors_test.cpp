// An error in a file is reported in one line that names the file, the line and the element.
#include <algorithm>

#include "tests/geometry/gdml/gdml_files.hpp"

namespace navjit::testing {
namespace {

class GdmlErrors : public GdmlFiles {
 protected:
  /// Every error names the file and an element, in one line.
  void expect(const std::string& text, const std::string& line_and_element,
              const std::string& problem) {
    const std::string message = error_of(text);
    EXPECT_HAS(message, (folder_ / "det.gdml").string() + ':' + line_and_element + ": ");
    EXPECT_HAS(message, problem);
    EXPECT_LACKS(message, "\n");
  }
  /// What nothing uses is left out with a note in the words of the error.
  void expect_note(const std::string& text, const std::string& line_and_element,
                   const std::string& problem) {
    GdmlReport report;
    EXPECT_NO_THROW(read(text, &report)) << text;
    const std::string place = (folder_ / "det.gdml").string() + ':' + line_and_element + ": ";
    const bool told = std::any_of(report.notes.begin(), report.notes.end(), [&](auto& note) {
      return note.starts_with(place) && note.find(problem) != std::string::npos &&
             note.find('\n') == std::string::npos;
    });
    EXPECT_TRUE(told) << place << problem << " is not noted for\n" << text;
  }
  /// `used`: a part of a physvol that uses the definition; nothing where that is not possible.
  void expect_in_define(const std::string& define, const std::string& element,
                        const std::string& problem, const std::string& used = "") {
    expect_note(Gdml{.define = "\n" + define, .structure = volume("W")}, "4: " + element, problem);
    if (used.empty()) return;
    expect(Gdml{.define = "\n" + define, .structure = volume("W", physvol("D", used))},
           "4: " + element, problem);
  }
  void expect_in_solids(const std::string& solids, const std::string& element,
                        const std::string& problem, const std::string& used = "s") {
    expect_note(Gdml{.solids = "\n" + solids, .structure = volume("W")}, "6: " + element, problem);
    if (used.empty()) return;
    expect(Gdml{.solids = "\n" + solids,
                .structure = "<volume name='W'><solidref ref='" + used + "'/></volume>"},
           "6: " + element, problem);
  }
  /// Refused, used or not.
  void expect_refused_in_solids(const std::string& solids, const std::string& element,
                                const std::string& problem) {
    expect(Gdml{.solids = "\n" + solids, .structure = volume("W")}, "6: " + element, problem);
  }
  void expect_in_structure(const std::string& structure, const std::string& element,
                           const std::string& problem) {
    expect(Gdml{.structure = "\n" + structure}, "7: " + element, problem);
  }
};

TEST_F(GdmlErrors, Definitions) {
  const std::string uses_c = "<position x='c'/>", uses_p = "<positionref ref='p'/>",
                    uses_m = "<position x='m[1]'/>";
  expect_in_define("<constant value='1'/>", "<constant>", "it has no name");
  expect_in_define("<constant name='c'/>", "<constant name='c'>", "attribute 'value' is missing",
                   uses_c);
  expect_in_define("<constant name='c' value='x'/>", "<constant name='c'>",
                   "value: unknown name 'x'", uses_c);
  expect_in_define("<constant name='c' value='nan'/>", "<constant name='c'>", "unknown name 'nan'",
                   uses_c);
  expect_in_define("<constant name='c' value='1e999'/>", "<constant name='c'>", "not a finite",
                   uses_c);
  expect_in_define("<constant name='c' value='1'/><variable name='c' value='2'/>",
                   "<variable name='c'>", "'c' is already defined", uses_c);
  expect_in_define("<constant name='mm' value='x'/>", "<constant name='mm'>", "unknown name 'x'",
                   "<position x='mm'/>");
  expect_in_define("<expression name='c'>1+</expression>", "<expression name='c'>",
                   "its text: ", uses_c);
  expect_in_define("<quantity name='c' value='1' unit='furlong'/>", "<quantity name='c'>",
                   "unit: 'furlong' is not a unit", uses_c);
  expect_in_define("<position name='p' x='1' unit='deg'/>", "<position name='p'>",
                   "unit: 'deg' is not a unit of length; use mm", uses_p);
  expect_in_define("<position name='p'/><position name='p' x='a'/>", "<position name='p'>",
                   "x: unknown name 'a'", uses_p);
  expect_in_define("<rotation name='r' x='1' unit='furlong'/>", "<rotation name='r'>",
                   "unit: 'furlong' is not a unit of angle; use deg", "<rotationref ref='r'/>");
  expect_in_define("<scale name='s' x='a'/>", "<scale name='s'>", "x: unknown name 'a'",
                   "<scaleref ref='s'/>");
  expect_in_define("<position name='p' x='1e300'/>", "<position name='p'>", "beyond 1e30 mm",
                   uses_p);
  expect_in_define("<matrix name='m' coldim='2' values='1 2 3'/>", "<matrix name='m'>",
                   "3 values in rows of coldim=2", uses_m);
  expect_in_define("<matrix name='m' coldim='0' values='1'/>", "<matrix name='m'>", "coldim=0",
                   uses_m);
  expect_in_define("<matrix name='m' coldim='-1' values='1'/>", "<matrix name='m'>", "coldim=-1",
                   uses_m);
  expect_in_define("<matrix name='m' coldim='1' values=''/>", "<matrix name='m'>", "0 values",
                   uses_m);
  expect_in_define("<matrix name='m' coldim='1' values='x 1'/>", "<matrix name='m'>",
                   "values: unknown name 'x'", uses_m);
  expect_in_define("<tensor name='t'/>", "<tensor name='t'>", "unknown kind");
  const std::string longest(70'000, 'c');
  expect(Gdml{.define = "\n<constant name='" + longest + "' value='1'/>", .structure = volume("W")},
         "4: <constant name='" + longest.substr(0, 200) + "...'>", "longer than 65536 characters");
}

TEST_F(GdmlErrors, Solids) {
  expect_in_solids("<box x='1' y='1' z='1'/>", "<box>", "it has no name", "");
  expect_in_solids("<box name='s' x='1' y='1'/>", "<box name='s'>", "attribute 'z' is missing");
  expect_in_solids("<box name='s' x='1' y='' z='1'/>", "<box name='s'>", "positive");
  expect_in_solids("<box name='s' x='1' y='abc' z='1'/>", "<box name='s'>", "unknown name 'abc'");
  expect_in_solids("<box name='s' x='-1' y='1' z='1'/>", "<box name='s'>", "positive");
  expect_in_solids("<box name='s' x='1' y='1' z='1' lunit='deg'/>", "<box name='s'>",
                   "lunit: 'deg' is not a unit of length");
  expect_in_solids("<tube name='s' rmax='1' z='1' deltaphi='1' aunit='mm'/>", "<tube name='s'>",
                   "aunit: 'mm' is not a unit of angle");
  expect_in_solids("<tube name='s' rmin='2' rmax='1' z='1' deltaphi='1'/>", "<tube name='s'>",
                   "rmin");
  expect_in_solids("<tube name='s' rmax='1' z='1'/>", "<tube name='s'>",
                   "attribute 'deltaphi' is missing");
  expect_in_solids("<polycone name='s' deltaphi='1'/>", "<polycone name='s'>", "zplane");
  expect_in_solids("<polycone name='s' deltaphi='1'><plane/></polycone>", "<plane>",
                   "unknown element");
  expect_refused_in_solids(
      "<polyhedra name='s' deltaphi='1' numsides='1e9'><zplane z='0' rmax='1'/>"
      "<zplane z='1' rmax='1'/></polyhedra>",
      "<polyhedra name='s'>", "sides");
  expect_in_solids(
      "<polyhedra name='s' deltaphi='1' numsides='-4'><zplane z='0' rmax='1'/>"
      "<zplane z='1' rmax='1'/></polyhedra>",
      "<polyhedra name='s'>", "sides");
}

TEST_F(GdmlErrors, UnsupportedSolidsNameTheirOwnLine) {
  expect(Gdml{.solids = "\n<blob name='t'/>",
              .structure = "\n<volume name='W'><solidref ref='t'/></volume>"},
         "6: <blob name='t'>", "unsupported solid 'blob'");
  expect(Gdml{.solids = "\n<nonsense name='t'/><union name='u'><first ref='b'/><second "
                        "ref='t'/></union>",
              .structure = "<volume name='W'><solidref ref='u'/></volume>"},
         "6: <nonsense name='t'>", "unsupported solid 'nonsense'");
}

TEST_F(GdmlErrors, Booleans) {
  const auto expect_boolean = [&](const std::string& solids, const std::string& element,
                                  const std::string& problem) {
    expect(
        Gdml{.solids = "\n" + solids, .structure = "<volume name='W'><solidref ref='u'/></volume>"},
        "6: " + element, problem);
    EXPECT_EQ(top(read(Gdml{.solids = solids, .structure = volume("W")})).name, "W");
  };
  expect_boolean("<union name='u'><first ref='b'/></union>", "<union name='u'>", "no <second>");
  expect_boolean("<union name='u'><second ref='b'/></union>", "<union name='u'>", "no <first>");
  expect_boolean("<union name='u'><first ref='x'/><second ref='b'/></union>", "<first ref='x'>",
                 "solid 'x' is not defined");
  expect_boolean("<union name='u'><first/><second ref='b'/></union>", "<first>",
                 "attribute 'ref' is missing");
  expect_refused_in_solids("<union name='u'><first ref='b'/><second ref='u'/></union>",
                           "<second ref='u'>", "solid 'u' contains itself");
  expect_boolean(
      "<union name='u'><first ref='b'/><second ref='v'/></union>"
      "<union name='v'><first ref='b'/><second ref='u'/></union>",
      "<second ref='v'>", "solid 'v' is defined only later");
  expect_boolean("<union name='u'><first ref='b'/><second ref='b'/><third/></union>", "<third>",
                 "unknown element");
  expect_boolean("<union name='u'><first ref='b'/><second ref='b'/><positionref ref='p'/></union>",
                 "<positionref ref='p'>", "position 'p' is not defined");
  expect_boolean(
      "<intersection name='u'><first ref='b'/><second ref='b'/><position x='500'/>"
      "</intersection>",
      "<intersection name='u'>", "do not meet");
}

TEST_F(GdmlErrors, DeepAndManyPartedBooleans) {
  std::string chain = "<box name='u0' x='1' y='1' z='1'/>", tree = chain, nest = chain,
              moved = chain;
  for (int i = 1; i <= 1001; ++i) {
    const std::string last = "ref='u" + std::to_string(i - 1) + "'/>";
    const std::string start = "<union name='u" + std::to_string(i) + "'><first " + last;
    chain += start + "<second ref='b'/></union>";
    if (i < 100) tree += start + "<second " + last + "</union>";
    // A union that is moved goes on with a chain, and what is cut from does not.
    moved += start + "<second ref='b'/><firstposition x='1'/></union>";
    nest += "<subtraction name='u" + std::to_string(i) + "'><first " + last +
            "<second ref='b'/><firstposition x='1'/></subtraction>";
  }
  expect_refused_in_solids(chain, "<union name='u1000'>", "more than 1000 booleans are chained");
  expect_refused_in_solids(moved, "<union name='u1000'>", "more than 1000 booleans are chained");
  expect_refused_in_solids(nest, "<subtraction name='u200'>", "nested more than 200 deep");
  expect_refused_in_solids(tree, "<union name='u14'>", "more than 10000 parts");
}

TEST_F(GdmlErrors, Structure) {
  expect_in_structure("<volume name='W'/>", "<volume name='W'>", "it has no solid");
  expect_in_structure("<volume name='W'><solidref ref='x'/></volume>", "<solidref ref='x'>",
                      "solid 'x' is not defined; define it before its use");
  expect_in_structure(volume("W", physvol("x")), "<volumeref ref='x'>",
                      "volume 'x' is not defined");
  expect_in_structure(volume("W", physvol("W")), "<volumeref ref='W'>",
                      "volume 'W' contains itself");
  expect_in_structure(volume("A", physvol("W")) + volume("W", physvol("A")), "<volumeref ref='W'>",
                      "volume 'W' is defined only later, or by itself, in line 7");
  expect_in_structure("<assembly name='A'>" + physvol("A") + "</assembly>", "<volumeref ref='A'>",
                      "volume 'A' contains itself");
  expect_in_structure("<assembly name='A'>" + physvol("B") + "</assembly><assembly name='B'>" +
                          physvol("A") + "</assembly>" + volume("W", physvol("B")),
                      "<volumeref ref='B'>", "is not defined");
  expect_in_structure(volume("W", "<physvol name='p'/>"), "<physvol name='p'>",
                      "it places no volume");
  expect_in_structure(volume("W", physvol("D", "<position x='a'/>")), "<position>", "x: unknown");
  expect_in_structure(volume("W", physvol("D", "<rotationref ref='r'/>")), "<rotationref ref='r'>",
                      "rotation 'r' is not defined");
  expect_in_structure(volume("W", physvol("D", "<colour/>")), "<colour>", "unknown element");
  expect_in_structure(volume("W", physvol("D", "<scale x='-2'/>")), "<scale>", "changes lengths");
  expect_in_structure(volume("W", "<physvol copynumber='x'/>"), "<physvol>", "places no volume");
  expect_in_structure(volume("W", "<paramvol/>"), "<paramvol>", "it has no <volumeref>");
  expect_in_structure("<box name='W'/>", "<box name='W'>", "unknown element in <structure>");
}

TEST_F(GdmlErrors, WholeFiles) {
  // The first setup cannot be left out for another one.
  expect(
      "<gdml><setup name='Default'>\n<world/></setup><setup name='x'><world "
      "ref='W'/></setup></gdml>",
      "2: <world>", "attribute 'ref' is missing");
  expect("<gdml/>", "1: <gdml>", "it has no <setup>");
  expect("<html/>", "1: <html>", "this is not a GDML file");
  expect("<gdml><what/></gdml>", "1: <gdml>", "it has no <setup>");
  expect_note(Gdml{.structure = volume("W") + "</structure><what/><structure>"}, "6: <what>",
              "unknown kind");
  expect(Gdml{.structure = volume("W"), .world = "X"}, "7: <world ref='X'>",
         "volume 'X' is not defined");
  expect(Gdml{.structure = "<assembly name='W'/>"}, "7: <world ref='W'>",
         "is an assembly that holds nothing");
}

TEST_F(GdmlErrors, TreesTooDeepOrTooLarge) {
  const auto nested = [](int levels, int copies) {
    std::string text = volume("V0");
    for (int i = 1; i < levels; ++i) {
      std::string daughters;
      for (int k = 0; k < copies; ++k) daughters += physvol("V" + std::to_string(i - 1));
      text += volume("V" + std::to_string(i), daughters);
    }
    return Gdml{.structure = text, .world = "V" + std::to_string(levels - 1)};
  };
  EXPECT_EQ(read(nested(64, 1)).depth, 64);
  EXPECT_HAS(error_of(nested(65, 1)), "<world ref='V64'>: the tree of volumes is 65 levels deep");
  EXPECT_EQ(top(read(nested(62, 2))).touchables, (TouchableId{1} << 62) - 1);
  EXPECT_HAS(error_of(nested(64, 2)), "holds more than 2^62 touchables");
  EXPECT_HAS(error_of(nested(20'000, 1)), "20000 levels deep");
  GdmlOptions few;
  few.limits.max_touchables = 1000;
  EXPECT_HAS(error_of(nested(10, 2), few), "the world has 1023 touchables");
}

}  // namespace
}  // namespace navjit::testing
