// Compares paramvol, and replicas outwards, with the placements that they stand for.
#include "tests/geometry/gdml/gdml_files.hpp"
#include "tests/geometry/gdml/same_traces.hpp"

namespace navjit::testing {
namespace {

/// A kind of solid with two sets of dimensions, each as a solid and as in a paramvol.
struct ParameterCase {
  const char* kind;
  std::string solids[2];      ///< attributes and children of the solid
  std::string dimensions[2];  ///< of the dimensions, where they differ
};
void PrintTo(const ParameterCase& c, std::ostream* out) { *out << c.kind; }

/// Makes "attributes|children" into an element.
std::string element(const std::string& tag, const std::string& name, const std::string& text) {
  const auto bar = std::min(text.find('|'), text.size());
  const std::string children = bar < text.size() ? text.substr(bar + 1) : "";
  return "<" + tag + (name.empty() ? "" : " name='" + name + "'") + " " + text.substr(0, bar) +
         ">" + children + "</" + tag + ">";
}

const ParameterCase parameter_cases[] = {
    {"box", {"x='4' y='6' z='8'", "x='8' y='2' z='2'"}, {}},
    {"tube",
     {"rmin='1' rmax='3' z='8' startphi='10' deltaphi='200' aunit='deg'",
      "rmax='4' z='6' deltaphi='7'"},
     {"InR='1' OutR='3' hz='8' StartPhi='10' DeltaPhi='200' aunit='deg'",
      "InR='0' OutR='4' hz='6' StartPhi='0' DeltaPhi='7'"}},
    {"cone",
     {"rmin1='1' rmax1='3' rmin2='2' rmax2='4' z='6' deltaphi='7'",
      "rmax1='1' rmax2='4' z='8' deltaphi='3'"},
     {}},
    {"orb", {"r='4'", "r='2'"}, {}},
    {"sphere",
     {"rmin='1' rmax='4' startphi='0' deltaphi='7' starttheta='0' deltatheta='1'",
      "rmin='0' rmax='3' startphi='0' deltaphi='7' starttheta='0' deltatheta='4'"},
     {}},
    {"trd", {"x1='2' x2='4' y1='6' y2='4' z='8'", "x1='4' x2='4' y1='2' y2='4' z='4'"}, {}},
    {"trap",
     {"z='6' theta='0.1' phi='0.2' y1='4' x1='4' x2='4' alpha1='0.1' y2='4' x3='4' x4='4' "
      "alpha2='0.1'",
      "z='4' theta='0' phi='0' y1='2' x1='4' x2='2' alpha1='0' y2='2' x3='4' x4='2' alpha2='0'"},
     {}},
    {"para",
     {"x='4' y='4' z='6' alpha='0.1' theta='0.2' phi='0.3'",
      "x='2' y='4' z='4' alpha='0' theta='0.2' phi='0'"},
     {}},
    {"torus",
     {"rmin='0' rmax='1' rtor='3' deltaphi='7'", "rmin='1' rmax='2' rtor='3' deltaphi='4'"},
     {}},
    {"hype",
     {"rmin='1' rmax='3' inst='0.1' outst='0.3' z='6'",
      "rmin='0' rmax='2' inst='0' outst='0.2' z='8'"},
     {}},
    {"polycone",
     {"startphi='0.5' deltaphi='4'|<zplane z='-3' rmin='1' rmax='3'/><zplane z='3' rmin='1' "
      "rmax='4'/>",
      "deltaphi='7'|<zplane z='-1' rmax='1'/><zplane z='2' rmax='4'/><zplane z='3' rmax='1'/>"},
     {"startPhi='0.5' openPhi='4' numRZ='2'|<zplane z='-3' rmin='1' rmax='3'/><zplane z='3' "
      "rmin='1' rmax='4'/>",
      "startPhi='0' openPhi='7' numRZ='3'|<zplane z='-1' rmax='1'/><zplane z='2' rmax='4'/><zplane "
      "z='3' rmax='1'/>"}},
    // The radii in a paramvol are those of the edges: here those of the sides by 1/cos(45 deg).
    {"polyhedra",
     {"deltaphi='360' aunit='deg' numsides='4'|<zplane z='-3' rmin='1' rmax='2'/><zplane z='3' "
      "rmin='1' rmax='3'/>",
      "startphi='10' deltaphi='180' aunit='deg' numsides='2'|<zplane z='-2' rmax='2'/><zplane "
      "z='3' rmax='3'/>"},
     {"startPhi='0' openPhi='360' aunit='deg' numRZ='2' numSide='4'|<zplane z='-3' rmin='sqrt(2)' "
      "rmax='2*sqrt(2)'/>"
      "<zplane z='3' rmin='sqrt(2)' rmax='3*sqrt(2)'/>",
      "startPhi='10' openPhi='180' aunit='deg' numRZ='2' numSide='2'|<zplane z='-2' "
      "rmax='2*sqrt(2)'/>"
      "<zplane z='3' rmax='3*sqrt(2)'/>"}},
    {"ellipsoid", {"ax='4' by='3' cz='2'", "ax='1' by='3' cz='4' zcut1='-1' zcut2='2'"}, {}},
};

class GdmlParamvols : public GdmlFiles, public ::testing::WithParamInterface<ParameterCase> {};

std::string lead(const std::string& name, const std::string& solid, const std::string& rest = "") {
  return "<volume name='" + name + "'><materialref ref='G4_Pb'/><solidref ref='" + solid + "'/>" +
         rest + "</volume>";
}

TEST_P(GdmlParamvols, AreThePlacementsTheyStandFor) {
  const ParameterCase& c = GetParam();
  const std::string frames[] = {"<position x='-5' y='1'/>",
                                "<position x='5'/><rotation x='30' z='50' unit='deg'/>"};
  std::string solids = "<orb name='o' r='0.1'/>", volumes = lead("I", "o"), daughters, parameters;
  for (int i = 0; i < 2; ++i) {
    const std::string n = std::to_string(i);
    solids += element(c.kind, "s" + n, c.solids[i]);
    volumes += lead("S_" + n, "s" + n, physvol("I"));
    daughters += physvol("S_" + n, frames[i]);
    const std::string& dimensions = c.dimensions[0].empty() ? c.solids[i] : c.dimensions[i];
    parameters += "<parameters number='1'>" +
                  element(c.kind + std::string("_dimensions"), "", dimensions) + frames[i] +
                  "</parameters>";
  }
  const World placed = read(Gdml{.solids = solids, .structure = volumes + volume("W", daughters)});
  const World all = read(Gdml{
      .solids = solids,
      .structure =
          lead("I", "o") + lead("S", "s0", physvol("I")) +
          volume("W", "<paramvol ncopies='2'><volumeref ref='S'/><parameterised_position_size>" +
                          parameters + "</parameterised_position_size></paramvol>")});
  ASSERT_EQ(top(all).daughters.size(), 2u);
  EXPECT_EQ(top(all).daughters[1].name, "S_param_1");
  EXPECT_EQ(top(all).daughters[1].copy_number, 1);
  EXPECT_EQ(all.volumes[top(all).daughters[1].volume].name, "S");
  EXPECT_EQ(all.volumes[top(all).daughters[1].volume].daughters.size(), 1u)
      << "those of the volume";
  EXPECT_NEAR(daughters_capacity(all) / daughters_capacity(placed), 1, 1e-9);
  expect_same_traces(all, placed);
}

INSTANTIATE_TEST_SUITE_P(Kinds, GdmlParamvols, ::testing::ValuesIn(parameter_cases),
                         [](const auto& test) { return std::string(test.param.kind); });

class GdmlParamvolFiles : public GdmlFiles {
 protected:
  static std::string with(const std::string& content) {
    return Gdml{
        .define = "<variable name='i' value='0'/>",
        .structure = volume("W", "<paramvol><volumeref ref='D'/>" + content + "</paramvol>")};
  }
};

TEST_F(GdmlParamvolFiles, Loop) {
  const std::string parameters =
      "<parameterised_position_size><parameters number='i'><box_dimensions x='i' y='2' z='2'/>"
      "<position x='3*i-6'/></parameters></parameterised_position_size>";
  const World world =
      read(with("<loop for='i' from='1' to='3' step='1'>" + parameters + "</loop>"));
  ASSERT_EQ(top(world).daughters.size(), 3u);
  EXPECT_EQ(top(world).daughters[2].transformation.translation[0], 3);
  EXPECT_EQ(world.volumes[top(world).daughters[2].volume].solid.extent.max.x, 1.5);
}

TEST_F(GdmlParamvolFiles, ShareVolumesOfTheSameDimensions) {
  std::string same;
  for (int i = 0; i < 4; ++i) {
    same += "<parameters number='1'><box_dimensions x='2' y='2' z='2'/><position z='" +
            std::to_string(4 * i - 6) + "'/></parameters>";
  }
  const World world =
      read(with("<parameterised_position_size>" + same + "</parameterised_position_size>"));
  EXPECT_EQ(world.volumes.size(), 3u);
  EXPECT_EQ(top(world).touchables, 5u);
}

class GdmlParamvolShapes : public GdmlFiles {
 protected:
  /// The solid of a copy whose dimensions these are; its volume has another solid of that kind.
  Solid copy_of(const std::string& kind, const std::string& own, const std::string& dimensions) {
    report_ = {};
    const World world = read(file(kind, own, dimensions), &report_);
    return world.volumes[top(world).daughters[0].volume].solid;
  }
  static std::string file(const std::string& kind, const std::string& own,
                          const std::string& dimensions) {
    return Gdml{.solids = element(kind, "s", own),
                .structure =
                    lead("S", "s") +
                    volume("W",
                           "<paramvol ncopies='1'><volumeref ref='S'/><parameterised_position_size>"
                           "<parameters number='1'>" +
                               element(kind + "_dimensions", "", dimensions) +
                               "</parameters></parameterised_position_size></paramvol>")};
  }
  GdmlReport report_;
};

TEST_F(GdmlParamvolShapes, TakeAsManyZPlanesAsTheySay) {
  const std::string planes =
      "<zplane z='-1' rmax='2'/><zplane z='1' rmax='3'/><zplane z='4' rmax='4'/>";
  for (const char* kind : {"polycone", "polyhedra"}) {
    const std::string sides = kind == std::string("polycone") ? "" : "numsides='4' ",
                      side = kind == std::string("polycone") ? "" : "numSide='4' ";
    const std::string own = sides + "deltaphi='7'|" + planes;
    const auto dimensions = [&](const std::string& count) {
      return side + "startPhi='0' openPhi='7' " + count + '|' + planes;
    };
    EXPECT_EQ(copy_of(kind, own, dimensions("numRZ='2'")).extent.max.z, 1) << kind;
    ASSERT_EQ(report_.notes.size(), 1U);
    EXPECT_HAS(report_.notes[0], "it has more <zplane>s than numRZ says: took the first of them");
    for (const char* all : {"numRZ='3'", ""}) {
      EXPECT_EQ(copy_of(kind, own, dimensions(all)).extent.max.z, 4) << kind << all;
      EXPECT_TRUE(report_.notes.empty());
    }
    for (const char* none : {"4", "1", "-2"}) {
      EXPECT_HAS(error_of(file(kind, own, dimensions("numRZ='" + std::string(none) + "'"))),
                 "numRZ is " + std::string(none) + ", and there are 3 <zplane>s");
    }
  }
}

TEST_F(GdmlParamvolShapes, PolyhedraThatSpanMoreThanATurnKeepTheirEdges) {
  const std::string planes = "<zplane z='-1' rmax='20'/><zplane z='1' rmax='20'/>";
  for (const char* opening : {"360", "361", "720", "0", "-5"}) {
    const Solid copy = copy_of("polyhedra", "numsides='6' deltaphi='7'|" + planes,
                               "numSide='6' numRZ='2' startPhi='0' aunit='deg' openPhi='" +
                                   std::string(opening) + "'|" + planes);
    EXPECT_NEAR(copy.extent.max.x, 20, 1e-9) << opening << ": the radius of an edge";
  }
}

TEST_F(GdmlParamvolFiles, SayWhatIsWrong) {
  const auto one = [](const std::string& dimensions) {
    return "<parameterised_position_size><parameters number='1'>" + dimensions +
           "</parameters></parameterised_position_size>";
  };
  EXPECT_HAS(error_of(with("")), "<paramvol>: it has no <parameters>");
  EXPECT_HAS(error_of(with(one("<orb_dimensions r='1'/>"))),
             "<orb_dimensions>: these are not dimensions of the volume's solid, a 'box'");
  EXPECT_HAS(error_of(with(one("<box_dimensions x='1' y='1' z='-1'/>"))), "positive");
  EXPECT_HAS(error_of(with(one("<box_dimensions x='1' y='1'/>"))), "attribute 'z' is missing");
  EXPECT_HAS(error_of(with(one("<colour/>"))), "unknown element in parameters");
  EXPECT_HAS(error_of(with("<colour/>")), "unknown element in a paramvol");
}

TEST_F(GdmlParamvolFiles, ReplicasGoOutwardsInTubes) {
  const std::string tube =
      "<tube name='t' rmin='2' rmax='8' z='10' startphi='1' deltaphi='3'/>"
      "<tube name='s' rmin='2' rmax='4' z='10' startphi='1' deltaphi='3'/>"
      "<tube name='s1' rmin='4' rmax='6' z='10' startphi='1' deltaphi='3'/>"
      "<tube name='s2' rmin='6' rmax='8' z='10' startphi='1' deltaphi='3'/>";
  const auto world_of = [&](const std::string& volumes, const std::string& daughters) {
    return read(Gdml{.solids = tube, .structure = volumes + lead("W", "t", daughters)});
  };
  const World replicas = world_of(
      lead("S", "s"),
      "<replicavol number='3'><volumeref ref='S'/><replicate_along_axis><direction rho='1'/>"
      "<width value='2' unit='mm'/><offset value='2' "
      "unit='mm'/></replicate_along_axis></replicavol>");
  const World placed = world_of(lead("S_0", "s") + lead("S_1", "s1") + lead("S_2", "s2"),
                                physvol("S_0") + physvol("S_1") + physvol("S_2"));
  EXPECT_NEAR(daughters_capacity(replicas) / capacity(top(replicas).solid), 1, 1e-12);
  expect_same_traces(replicas, placed);
}

}  // namespace
}  // namespace navjit::testing
