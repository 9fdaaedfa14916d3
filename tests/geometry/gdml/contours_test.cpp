// Solids from corners and contours, multiUnions, scaled and reflected solids, as GDML writes them.
#include <cmath>
#include <numbers>

#include "tests/geometry/gdml/gdml_files.hpp"

namespace navjit::testing {
namespace {

class GdmlContours : public GdmlFiles {
 protected:
  Solid solid(const std::string& text, const std::string& define = "") const {
    return top(read(file(text, define))).solid;
  }
  static Gdml file(const std::string& text, const std::string& define = "") {
    return Gdml{.define = define,
                .solids = text,
                .structure =
                    "<volume name='W'><materialref ref='G4_AIR'/><solidref ref='s'/>"
                    "</volume>"};
  }
  static bool has(const Solid& s, double x, double y, double z) {
    return kernels::inside(s.any(), Vec3{x, y, z}, 1e-9) == Side::inside;
  }
};

TEST_F(GdmlContours, ExtrudedSolids) {
  const std::string corners =
      "<twoDimVertex x='0' y='0'/><twoDimVertex x='2' y='0'/><twoDimVertex x='2' y='2'/>"
      "<twoDimVertex x='0' y='2'/>";
  const Solid s = solid("<xtru name='s' lunit='cm'>" + corners +
                        "<section zOrder='1' zPosition='-1' xOffset='0' yOffset='0' "
                        "scalingFactor='1'/><section zOrder='2' zPosition='1' xOffset='1' "
                        "yOffset='0' scalingFactor='2'/></xtru>");
  EXPECT_NEAR(s.extent.max.x, 50, 1e-12);
  EXPECT_NEAR(s.extent.max.z, 10, 1e-12);
  EXPECT_TRUE(has(s, 1, 1, -9.9));
  EXPECT_FALSE(has(s, 1, 1, 9.9));
  EXPECT_HAS(error_of(file("<xtru name='s'><zplane/></xtru>")), "twoDimVertex or section");
  const auto polygon = [](const std::string& points) {
    return "<xtru name='s'>" + points +
           "<section zOrder='1' zPosition='-1'/><section zOrder='2' zPosition='1'/></xtru>";
  };
  const std::string start =
      "<twoDimVertex x='0' y='0'/><twoDimVertex x='9' y='0'/><twoDimVertex x='9' y='9'/>";
  GdmlReport report;
  const Solid touching = top(read(file(polygon(start + "<twoDimVertex x='5' y='-0.001'/>"
                                                       "<twoDimVertex x='0' y='9'/>")),
                                  &report))
                             .solid;
  EXPECT_TRUE(has(touching, 7, 1, 0));
  EXPECT_FALSE(has(touching, 5, 5, 0));
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_HAS(report.notes[0],
             "det.gdml:5: <xtru name='s'>: its polygon touches or crosses itself: took what it "
             "surrounds: surrounds ");
  EXPECT_HAS(error_of(file(polygon(start + "<twoDimVertex x='4' y='-9'/>"))), "crosses itself");
  EXPECT_HAS(error_of(file("<xtru name='s'>" + corners + "</xtru>")), "less than two sections");
}

TEST_F(GdmlContours, ExtrudedSolidsWithSteps) {
  const std::string corners =
      "<twoDimVertex x='-1' y='-1'/><twoDimVertex x='1' y='-1'/><twoDimVertex x='1' y='1'/>"
      "<twoDimVertex x='-1' y='1'/>";
  const auto section = [](int z, int x, int scale) {
    return "<section zOrder='0' zPosition='" + std::to_string(z) + "' xOffset='" +
           std::to_string(x) + "' scalingFactor='" + std::to_string(scale) + "'/>";
  };
  GdmlReport report;
  const Solid s = top(read(file("<xtru name='s'>" + corners + section(-9, 0, 1) + section(0, 0, 1) +
                                section(0, 0, 1) + section(0, 0, 5) + section(9, 3, 5) + "</xtru>"),
                           &report))
                      .solid;
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_HAS(report.notes[0], "it has two sections at one z");
  EXPECT_EQ(s.name, "s");
  EXPECT_TRUE(has(s, 0.9, 0.9, -1));
  EXPECT_FALSE(has(s, 1.1, 0.9, -1));
  EXPECT_TRUE(has(s, 4.9, 4.9, 1));
  const kernels::Direction up = kernels::make_direction(0.0, 0.0, 1.0);
  EXPECT_NEAR(kernels::distance_to_out(s.any(), Vec3{0, 0, -8}, up, 1e-9), 17, 1e-9)
      << "where the bodies touch the solid goes on";
  EXPECT_TRUE(has(s, 7.5, 0, 8.9));
  EXPECT_FALSE(has(s, -2.5, 0, 8.9));
  EXPECT_HAS(error_of(file("<xtru name='s'>" + corners + section(0, 0, 1) + section(9, 0, 1) +
                           section(1, 0, 1) + "</xtru>")),
             "must ascend in z");
}

TEST_F(GdmlContours, ArbsAndTheirHalfLength) {
  const Solid s = solid(
      "<arb8 name='s' lunit='cm' dz='2' v1x='-1' v1y='-1' v2x='-1' v2y='1' v3x='1' v3y='1' "
      "v4x='1' v4y='-1' v5x='-1' v5y='-1' v6x='-1' v6y='1' v7x='1' v7y='1' v8x='3' v8y='-1'/>");
  EXPECT_EQ(s.kind, SolidKind::arb8);
  EXPECT_NEAR(s.extent.max.z, 20, 1e-12);
  EXPECT_TRUE(has(s, 25, -9.9, 19.9));
  EXPECT_FALSE(has(s, 25, 9, 19.9));
}

TEST_F(GdmlContours, FacetsByTheNamesOfTheirCorners) {
  const std::string define =
      "<position name='a' x='0' y='0' z='0'/><position name='b' x='1' y='0' z='0' unit='cm'/>"
      "<position name='c' x='0' y='1' z='0' unit='cm'/><position name='d' x='0' y='0' z='1' "
      "unit='cm'/><position name='cb' x='-10' y='10'/><position name='db' x='-10' z='10'/>";
  const std::string rest =
      "<triangular vertex1='a' vertex2='c' vertex3='b'/>"
      "<triangular vertex1='a' vertex2='b' vertex3='d'/>"
      "<triangular vertex1='a' vertex2='d' vertex3='c' type='ABSOLUTE'/></tessellated>";
  const Solid s = solid(
      "<tessellated name='s'><triangular vertex1='b' vertex2='cb' vertex3='db' "
      "type='RELATIVE'/>" +
          rest,
      define);
  EXPECT_TRUE(has(s, 2, 2, 2));
  EXPECT_FALSE(has(s, 4, 4, 4));
  // One facet is missing.
  GdmlReport report;
  EXPECT_TRUE(
      has(top(read(file("<tessellated name='s'>" + rest, define), &report)).solid, 2, 2, 2));
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_HAS(report.notes[0],
             "det.gdml:5: <tessellated name='s'>: its facets do not close on one another: closed "
             "them: open at 3 edges; added 1 facet");
  EXPECT_HAS(error_of(file("<tessellated name='s'><triangular vertex1='a' vertex2='b' "
                           "vertex3='c'/></tessellated>",
                           define)),
             "less than four facets");
  EXPECT_HAS(error_of(file("<tessellated name='s'><triangular vertex1='a' vertex2='x' "
                           "vertex3='b'/></tessellated>",
                           define)),
             "position 'x'");
  EXPECT_TRUE(has(solid("<tet name='s' vertex1='a' vertex2='b' vertex3='c' vertex4='d'/>", define),
                  2, 2, 2));
}

TEST_F(GdmlContours, ContoursAndCuts) {
  const std::string points =
      "<rzpoint r='1' z='0'/><rzpoint r='3' z='0'/><rzpoint r='2' z='1'/><rzpoint r='3' z='2'/>"
      "<rzpoint r='1' z='2'/>";
  const Solid cone = solid(
      "<genericPolycone name='s' startphi='0' deltaphi='360' aunit='deg' "
      "lunit='cm'>" +
      points + "</genericPolycone>");
  EXPECT_TRUE(has(cone, 19, 0, 10));
  EXPECT_FALSE(has(cone, 25, 0, 10));
  const Solid sides = solid(
      "<genericPolyhedra name='s' startphi='0' deltaphi='360' numsides='4' "
      "aunit='deg' lunit='cm'>" +
      points + "</genericPolyhedra>");
  EXPECT_NEAR(sides.extent.max.x, 30, 1e-9);
  EXPECT_FALSE(has(sides, 15, 15, 1));
  EXPECT_TRUE(has(sides, 28, 0, 1));
  const Solid cut = solid(
      "<cutTube name='s' rmin='0' rmax='1' z='4' deltaphi='360' aunit='deg' "
      "lowX='0' lowY='0' lowZ='-1' highX='1' highY='0' highZ='1'/>");
  EXPECT_TRUE(has(cut, -0.9, 0, 2.8));
  EXPECT_FALSE(has(cut, 0.9, 0, 1.2));
  EXPECT_NEAR(cut.extent.max.z, 3, 1e-12);
  EXPECT_TRUE(has(solid("<para name='s' x='2' y='2' z='4' alpha='0' theta='45' phi='0' "
                        "aunit='deg'/>"),
                  2.4, 0, 1.9));
}

TEST_F(GdmlContours, ManyAtOnceAndStretched) {
  const Solid many = solid(
      "<multiUnion name='s'><multiUnionNode name='1'><solid ref='b'/></multiUnionNode>"
      "<multiUnionNode name='2'><solid ref='b'/><position x='30'/></multiUnionNode>"
      "<multiUnionNode name='3'><solid ref='b'/><position y='30'/><rotation z='45' unit='deg'/>"
      "</multiUnionNode></multiUnion>");
  EXPECT_EQ(many.name, "s");
  EXPECT_TRUE(has(many, 39, 9, 9));
  EXPECT_FALSE(has(many, 15, 0, 0));
  EXPECT_TRUE(has(many, 0, 43, 0));
  EXPECT_HAS(error_of(file("<multiUnion name='s'/>")), "multiUnionNode");
  const Solid scaled =
      solid("<scaledSolid name='s'><solidref ref='b'/><scale x='1' y='2' z='0.5'/></scaledSolid>");
  EXPECT_TRUE(has(scaled, 9, 19, 4.9));
  EXPECT_FALSE(has(scaled, 9, 19, 5.1));
}

TEST_F(GdmlContours, ReflectedPlacements) {
  // The world is a trapezoid's mother; x is reversed, then turned with the frame.
  GdmlReport report;
  const World world =
      read(Gdml{.solids = "<trd name='t' x1='4' x2='4' y1='2' y2='8' z='6'/>"
                          "<tube name='q' rmax='5' z='6' deltaphi='90' aunit='deg'/>",
                .structure =
                    "<volume name='Q'><materialref ref='G4_Pb'/><solidref ref='q'/></volume>" +
                    volume("W", physvol("Q", "<position x='1'/><scale x='-1' y='1' z='1'/>") +
                                    physvol("Q", "<rotation z='90' unit='deg'/><scale z='-1'/>") +
                                    physvol("Q", "<scale x='2' y='3'/>"))},
           &report);
  const auto& daughters = top(world).daughters;
  ASSERT_EQ(daughters.size(), 3u);
  const auto in = [&](std::size_t i, double x, double y, double z) {
    const Vec3 p = to_local(daughters[i].transformation, Vec3{x, y, z});
    return has(world.volumes[daughters[i].volume].solid, p.x, p.y, p.z);
  };
  EXPECT_TRUE(in(0, 1 - 2, 2, 0));
  EXPECT_FALSE(in(0, 1 + 2, 2, 0));
  // The angle turns from mother to daughter.
  EXPECT_TRUE(in(1, 2, -2, 1));
  EXPECT_FALSE(in(1, 2, 2, 1));
  // Geant4 drops the size.
  EXPECT_TRUE(in(2, 2, 2, 0));
  EXPECT_FALSE(in(2, 8, 2, 0));
}

}  // namespace
}  // namespace navjit::testing
