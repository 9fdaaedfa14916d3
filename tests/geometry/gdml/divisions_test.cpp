// Compares divisionvol with the placements that it stands for, each with its solid written out.
#include <cmath>

#include "tests/geometry/gdml/gdml_files.hpp"
#include "tests/geometry/gdml/same_traces.hpp"

namespace navjit::testing {
namespace {

/// A solid, how it is divided, and the slices: their solids, with what else their physvols contain.
struct DivisionCase {
  const char* name;
  std::string mother;    ///< the attributes and children of its solid 'm'
  std::string daughter;  ///< its solid 'd', of other dimensions
  std::string attributes;
  std::vector<std::pair<std::string, std::string>> slices;
  bool whole = true;  ///< the slices fill the mother
};
void PrintTo(const DivisionCase& c, std::ostream* out) { *out << c.name; }

std::string at_z(double z) { return "<position z='" + std::to_string(z) + "'/>"; }
std::string at(double x, double y, double z) {
  return "<position x='" + std::to_string(x) + "' y='" + std::to_string(y) + "' z='" +
         std::to_string(z) + "'/>";
}
const std::string deg = " aunit='deg'";

std::vector<DivisionCase> cases() {
  const std::string tube = "<tube name='m' rmin='5' rmax='20' z='60' startphi='20' deltaphi='200'";
  const std::string some_tube = "<tube name='d' rmax='1' z='1' deltaphi='6'/>";
  const auto tube_of = [](double rmin, double rmax, double z, double start, double delta) {
    return "<tube rmin='" + std::to_string(rmin) + "' rmax='" + std::to_string(rmax) + "' z='" +
           std::to_string(z) + "' startphi='" + std::to_string(start) + "' deltaphi='" +
           std::to_string(delta) + "' aunit='deg'/>";
  };
  const std::string cone =
      "<cone name='m' rmin1='4' rmax1='10' rmin2='6' rmax2='24' z='60' startphi='-30' "
      "deltaphi='120'" +
      deg + "/>";
  const std::string some_cone =
      "<cone name='d' rmin1='1' rmax1='2' rmin2='1' rmax2='2' z='1' deltaphi='6'/>";
  const auto cone_of = [](double a, double b, double c, double d, double z, double start,
                          double delta) {
    return "<cone rmin1='" + std::to_string(a) + "' rmax1='" + std::to_string(b) + "' rmin2='" +
           std::to_string(c) + "' rmax2='" + std::to_string(d) + "' z='" + std::to_string(z) +
           "' startphi='" + std::to_string(start) + "' deltaphi='" + std::to_string(delta) +
           "' aunit='deg'/>";
  };
  const std::string trd = "<trd name='m' x1='30' x2='60' y1='20' y2='40' z='50'/>";
  const std::string some_trd = "<trd name='d' x1='1' x2='2' y1='1' y2='2' z='1'/>";
  const std::string para =
      "<para name='m' x='30' y='20' z='40' alpha='20' theta='30' phi='40'" + deg + "/>";
  const std::string some_para =
      "<para name='d' x='1' y='1' z='1' alpha='20' theta='30' phi='40'" + deg + "/>";
  const auto para_of = [](double x, double y, double z) {
    return "<para x='" + std::to_string(x) + "' y='" + std::to_string(y) + "' z='" +
           std::to_string(z) + "' alpha='20' theta='30' phi='40' aunit='deg'/>";
  };
  const std::string planes =
      "<zplane z='-10' rmin='2' rmax='10'/><zplane z='20' rmin='4' rmax='10'/><zplane z='50' "
      "rmin='4' rmax='22'/>";
  const auto poly = [](const std::string& kind, const std::string& rest,
                       const std::string& content) {
    return "<" + kind + " " + rest + " aunit='deg'>" + content + "</" + kind + ">";
  };
  const std::string phi = "startphi='10' deltaphi='240'";
  const std::string sides = phi + " numsides='4'";
  std::vector<DivisionCase> list = {
      {"TubeZ",
       tube + deg + "/>",
       some_tube,
       "axis='kZAxis' number='3'",
       {{tube_of(5, 20, 20, 20, 200), at_z(-20)},
        {tube_of(5, 20, 20, 20, 200), ""},
        {tube_of(5, 20, 20, 20, 200), at_z(20)}}},
      {"TubePhi",
       tube + deg + "/>",
       some_tube,
       "axis='kPhi' number='2' unit='deg'",
       {{tube_of(5, 20, 60, 20, 100), ""}, {tube_of(5, 20, 60, 120, 100), ""}}},
      {"TubePhiWidth",
       tube + deg + "/>",
       some_tube,
       "axis='kPhi' width='30' offset='15' unit='deg' number='2'",
       {{tube_of(5, 20, 60, 35, 30), ""}, {tube_of(5, 20, 60, 65, 30), ""}},
       false},
      {"TubePhiLessATurn",
       "<tube name='m' rmin='5' rmax='20' z='60' startphi='20' deltaphi='360' aunit='deg'/>",
       some_tube,
       "axis='kPhi' number='3' width='120' offset='-360' unit='deg'",
       {{tube_of(5, 20, 60, 20, 120), ""},
        {tube_of(5, 20, 60, 140, 120), ""},
        {tube_of(5, 20, 60, 260, 120), ""}}},
      {"TubePhiWidthLessATurn",
       tube + deg + "/>",
       some_tube,
       "axis='kPhi' width='90' offset='-340' unit='deg'",
       {{tube_of(5, 20, 60, 40, 90), ""}, {tube_of(5, 20, 60, 130, 90), ""}},
       false},
      {"TubeRho",
       tube + deg + "/>",
       some_tube,
       "axis='kRho' width='5' unit='mm'",
       {{tube_of(5, 10, 60, 20, 200), ""},
        {tube_of(10, 15, 60, 20, 200), ""},
        {tube_of(15, 20, 60, 20, 200), ""}}},
      {"ConeZ",
       cone,
       some_cone,
       "axis='kZAxis' width='30' unit='mm'",
       {{cone_of(4, 10, 5, 17, 30, -30, 120), at_z(-15)},
        {cone_of(5, 17, 6, 24, 30, -30, 120), at_z(15)}}},
      {"ConePhi",
       cone,
       some_cone,
       "axis='kPhi' number='2' unit='deg'",
       {{cone_of(4, 10, 6, 24, 60, -30, 60), ""}, {cone_of(4, 10, 6, 24, 60, 30, 60), ""}}},
      {"ConePhiOffset",
       cone,
       some_cone,
       "axis='kPhi' number='2' offset='40' unit='deg'",
       {{cone_of(4, 10, 6, 24, 60, 10, 40), ""}, {cone_of(4, 10, 6, 24, 60, 50, 40), ""}},
       false},
      {"ConeRho",
       cone,
       some_cone,
       "axis='kRho' number='3' unit='mm'",
       {{cone_of(4, 6, 6, 12, 60, -30, 120), ""},
        {cone_of(6, 8, 12, 18, 60, -30, 120), ""},
        {cone_of(8, 10, 18, 24, 60, -30, 120), ""}}},
      {"TrdZ",
       trd,
       some_trd,
       "axis='kZAxis' number='2'",
       {{"<trd x1='30' x2='45' y1='20' y2='30' z='25'/>", at_z(-12.5)},
        {"<trd x1='45' x2='60' y1='30' y2='40' z='25'/>", at_z(12.5)}}},
      {"TrdX",
       trd,
       some_trd,
       "axis='kXAxis' number='3'",
       {{"<arb8 dz='25' v1x='-15' v1y='-10' v2x='-15' v2y='10' v3x='-5' v3y='10' v4x='-5' "
         "v4y='-10' "
         "v5x='-30' v5y='-20' v6x='-30' v6y='20' v7x='-10' v7y='20' v8x='-10' v8y='-20'/>",
         ""},
        {"<arb8 dz='25' v1x='-5' v1y='-10' v2x='-5' v2y='10' v3x='5' v3y='10' v4x='5' v4y='-10' "
         "v5x='-10' v5y='-20' v6x='-10' v6y='20' v7x='10' v7y='20' v8x='10' v8y='-20'/>",
         ""},
        {"<arb8 dz='25' v1x='5' v1y='-10' v2x='5' v2y='10' v3x='15' v3y='10' v4x='15' v4y='-10' "
         "v5x='10' v5y='-20' v6x='10' v6y='20' v7x='30' v7y='20' v8x='30' v8y='-20'/>",
         ""}}},
      {"TrdY",
       trd,
       "<trap name='d' z='1' theta='0' phi='0' y1='1' x1='1' x2='1' alpha1='0' y2='1' x3='1' "
       "x4='1' alpha2='0'/>",
       "axis='kYAxis' number='2'",
       {{"<arb8 dz='25' v1x='-15' v1y='-10' v2x='-15' v2y='0' v3x='15' v3y='0' v4x='15' v4y='-10' "
         "v5x='-30' v5y='-20' v6x='-30' v6y='0' v7x='30' v7y='0' v8x='30' v8y='-20'/>",
         ""},
        {"<arb8 dz='25' v1x='-15' v1y='0' v2x='-15' v2y='10' v3x='15' v3y='10' v4x='15' v4y='0' "
         "v5x='-30' v5y='0' v6x='-30' v6y='20' v7x='30' v7y='20' v8x='30' v8y='0'/>",
         ""}}},
      {"ParaX",
       para,
       some_para,
       "axis='kXAxis' number='2'",
       {{para_of(15, 20, 40), at(-7.5, 0, 0)}, {para_of(15, 20, 40), at(7.5, 0, 0)}}},
      {"ParaY",
       para,
       some_para,
       "axis='kYAxis' number='2'",
       {{para_of(30, 10, 40), "<position x='-5*tan(20*deg)' y='-5'/>"},
        {para_of(30, 10, 40), "<position x='5*tan(20*deg)' y='5'/>"}}},
      {"ParaZ",
       para,
       some_para,
       "axis='kZAxis' number='2'",
       {{para_of(30, 20, 20),
         "<position x='-10*tan(30*deg)*cos(40*deg)' y='-10*tan(30*deg)*sin(40*deg)' z='-10'/>"},
        {para_of(30, 20, 20),
         "<position x='10*tan(30*deg)*cos(40*deg)' y='10*tan(30*deg)*sin(40*deg)' z='10'/>"}}},
  };
  for (const std::string kind : {"polycone", "polyhedra"}) {
    const bool flat = kind == "polyhedra";
    const std::string angles = flat ? sides : phi;
    const std::string mother = poly(kind, "name='m' " + angles, planes);
    const std::string daughter =
        poly(kind, "name='d' " + angles, "<zplane z='0' rmax='1'/><zplane z='1' rmax='1'/>");
    const auto slice = [&](const std::string& content) { return poly(kind, angles, content); };
    list.push_back(
        {flat ? "PolyhedraPlanes" : "PolyconePlanes",
         mother,
         daughter,
         "axis='kZAxis' number='2'",
         {{slice("<zplane z='-10' rmin='2' rmax='10'/><zplane z='20' rmin='4' rmax='10'/>"), ""},
          {slice("<zplane z='20' rmin='4' rmax='10'/><zplane z='50' rmin='4' rmax='22'/>"), ""}}});
    list.push_back({flat ? "PolyhedraZ" : "PolyconeZ",
                    mother,
                    daughter,
                    "axis='kZAxis' width='40' offset='10' unit='mm' number='1'",
                    {{slice("<zplane z='0' rmin='2.6666666666666667' rmax='10'/><zplane z='20' "
                            "rmin='4' rmax='10'/>"
                            "<zplane z='40' rmin='4' rmax='18'/>"),
                      ""}},
                    false});
    list.push_back({flat ? "PolyhedraRho" : "PolyconeRho",
                    mother,
                    daughter,
                    "axis='kRho' number='2' unit='mm'",
                    {{slice("<zplane z='-10' rmin='2' rmax='6'/><zplane z='20' rmin='4' "
                            "rmax='7'/><zplane z='50' rmin='4' rmax='13'/>"),
                      ""},
                     {slice("<zplane z='-10' rmin='6' rmax='10'/><zplane z='20' rmin='7' "
                            "rmax='10'/><zplane z='50' rmin='13' rmax='22'/>"),
                      ""}}});
    const auto sector = [&](int start) {
      return poly(
          kind,
          "startphi='" + std::to_string(start) + "' deltaphi='60'" + (flat ? " numsides='1'" : ""),
          planes);
    };
    list.push_back({flat ? "PolyhedraPhi" : "PolyconePhi",
                    mother,
                    daughter,
                    "axis='kPhi' number='4' unit='deg'",
                    {{sector(10), ""}, {sector(70), ""}, {sector(130), ""}, {sector(190), ""}}});
  }
  return list;
}

class GdmlDivisions : public GdmlFiles, public ::testing::WithParamInterface<DivisionCase> {};

std::string in_world(const std::string& solids, const std::string& volumes,
                     const std::string& daughters) {
  return Gdml{.solids = solids,
              .structure = volumes +
                           "<volume name='W'><materialref ref='G4_AIR'/><solidref ref='m'/>" +
                           daughters + "</volume>"};
}
std::string volume_of(const std::string& name, const std::string& solid) {
  return "<volume name='" + name + "'><materialref ref='G4_Pb'/><solidref ref='" + solid +
         "'/></volume>";
}

TEST_P(GdmlDivisions, AreThePlacementsTheyStandFor) {
  const DivisionCase& c = GetParam();
  const World divided =
      read(in_world(c.mother + c.daughter, volume_of("S", "d"),
                    "<divisionvol " + c.attributes + "><volumeref ref='S'/></divisionvol>"));
  std::string solids = c.mother, volumes, daughters;
  for (std::size_t i = 0; i < c.slices.size(); ++i) {
    std::string solid = c.slices[i].first;
    const std::string name = "s" + std::to_string(i), volume = "S_" + std::to_string(i);
    solids += solid.insert(solid.find_first_of(' '), " name='" + name + "'");
    volumes += volume_of(volume, name);
    daughters += physvol(volume, c.slices[i].second);
  }
  const World placed = read(in_world(solids, volumes, daughters));
  ASSERT_EQ(top(divided).daughters.size(), c.slices.size());
  for (std::size_t i = 0; i < c.slices.size(); ++i) {
    const Placement& p = top(divided).daughters[i];
    EXPECT_EQ(p.copy_number, static_cast<int>(i));
    EXPECT_EQ(divided.volumes[p.volume].name, "S");
    EXPECT_NEAR(capacity(divided.volumes[p.volume].solid) /
                    capacity(placed.volumes[top(placed).daughters[i].volume].solid),
                1, 1e-9);
  }
  if (c.whole) {
    EXPECT_NEAR(daughters_capacity(divided) / capacity(top(divided).solid), 1, 1e-9);
  }
  expect_same_traces(divided, placed);
}

INSTANTIATE_TEST_SUITE_P(Kinds, GdmlDivisions, ::testing::ValuesIn(cases()),
                         [](const auto& test) { return std::string(test.param.name); });

class GdmlDivisionErrors : public GdmlFiles {
 protected:
  std::string error_of_division(const std::string& mother, const std::string& daughter,
                                const std::string& attributes) {
    return error_of(in_world(mother + daughter, volume_of("S", "d"),
                             "<divisionvol " + attributes + "><volumeref ref='S'/></divisionvol>"));
  }
};

TEST_F(GdmlDivisionErrors, SayWhatCannotBe) {
  const std::string tube = "<tube name='m' rmax='20' z='60' deltaphi='6'/>";
  const std::string other = "<tube name='d' rmax='1' z='1' deltaphi='6'/>";
  EXPECT_HAS(error_of_division(tube, other, "axis='kXAxis' number='2'"),
             "unsupported structure 'divisionvol' of a tube along this axis");
  EXPECT_HAS(error_of_division(tube, other, "axis='x' number='2'"), "axis: 'x' is unknown");
  EXPECT_HAS(error_of_division(tube, other, "axis='kPhi' number='2' unit='mm'"),
             "not a unit of angle");
  EXPECT_HAS(error_of_division(tube, other, "axis='kPhi' number='2' width='4'"), "reach out");
  EXPECT_HAS(error_of_division("<tube name='m' rmax='20' z='60' deltaphi='3'/>", other,
                               "axis='kPhi' number='2' width='1' offset='-0.5'"),
             "reach out");
  EXPECT_HAS(error_of_division(tube, "<box name='d' x='1' y='1' z='1'/>", "axis='kPhi' number='2'"),
             "must have a solid of the mother's kind, 'tube'");
  EXPECT_HAS(error_of_division("<orb name='m' r='9'/>", other, "axis='kPhi' number='2'"),
             "unsupported structure 'divisionvol' in a mother that is no");
  const std::string cone =
      "<polycone name='m' deltaphi='6'><zplane z='0' rmax='9'/><zplane z='9' rmax='9'/></polycone>";
  const std::string small =
      "<polycone name='d' deltaphi='6'><zplane z='0' rmax='1'/><zplane z='1' rmax='1'/></polycone>";
  EXPECT_HAS(error_of_division(cone, small, "axis='kZAxis' number='2'"), "divided at its z planes");
}

}  // namespace
}  // namespace navjit::testing
