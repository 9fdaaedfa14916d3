// Dimensions that Geant4's constructors report as errors, but that have a natural meaning.
#include "tests/geometry/gdml/gdml_files.hpp"

namespace navjit::testing {
namespace {

using kernels::Side;

class GdmlOddSolids : public GdmlFiles {
 protected:
  static std::string world_of(const std::string& text) {
    return Gdml{.solids = text,
                .structure =
                    "<volume name='W'><materialref ref='G4_AIR'/><solidref "
                    "ref='s'/></volume>"};
  }
  /// The solid 's' of this text, which must be noted in these words.
  Solid noted(const std::string& text, const std::string& note) const {
    GdmlReport report;
    const World world = read(world_of(text), &report);
    std::string notes;
    for (const std::string& line : report.notes) notes += line + '\n';
    EXPECT_HAS(notes, note);
    return top(world).solid;
  }
};

Side where(const Solid& s, double x, double y, double z) {
  return kernels::inside(s.any(), Vec3{x, y, z}, 1e-9);
}

TEST_F(GdmlOddSolids, TrapsThatAreNotPlanarJoinTheirCorners) {
  const Solid s = noted(
      "<trap name='s' z='2' theta='0' phi='0' y1='2' x1='2' x2='2' alpha1='0' y2='2' x3='2' "
      "x4='6' alpha2='0'/>",
      ":5: <trap name='s'>: its sides are not planar");
  EXPECT_EQ(s.kind, SolidKind::arb8);
  EXPECT_EQ(where(s, 1.5, 0, 0), Side::surface);
  EXPECT_EQ(where(s, 2.9, 0.999, 0.999), Side::inside);
}

TEST_F(GdmlOddSolids, SlantsLoseHalfTurns) {
  // 60 rad, where 60 degrees were meant: tan(60) = 0.32.
  const char* const text = "<para name='s' x='2' y='2' z='10' alpha='0' theta='%' phi='0'/>";
  const auto with = [&](const std::string& theta) {
    return std::string(text).replace(std::string(text).find('%'), 1, theta);
  };
  const Solid s = noted(with("60"), ":5: <para name='s'>: theta is more than a right angle");
  EXPECT_NEAR(s.extent.max.x, 1 + 5 * std::tan(60.0), 1e-9);
  EXPECT_EQ(where(s, 5 * std::tan(60.0), 0, 4.999), Side::inside);
  // The tangent of what is left of a right angle is still refused.
  GdmlReport report;
  EXPECT_THROW(read(world_of(with("pi/2")), &report), GdmlError);
  EXPECT_TRUE(noted(with("0.5"), "").extent.max.x > 1);
}

TEST_F(GdmlOddSolids, TwistedTrapsTakeLinearSections) {
  const Solid s = noted(
      "<twistedtrap name='s' PhiTwist='0.5' z='2' Theta='0' Phi='0' y1='2' x1='2' x2='2' y2='2' "
      "x3='2' x4='6' Alph='0'/>",
      ":5: <twistedtrap name='s'>: its untwisted sides are not planar");
  EXPECT_EQ(where(s, 1.5, 0, 0), Side::surface);
  EXPECT_EQ(where(s, 1, -1, 0), Side::surface);
  EXPECT_EQ(where(s, 2, 1, 0), Side::surface);
}

TEST_F(GdmlOddSolids, WideToriCoverTheAxis) {
  const Solid s = noted("<torus name='s' rmin='1' rmax='5' rtor='3' deltaphi='360' aunit='deg'/>",
                        "<torus name='s'>: rmax >= rtor");
  EXPECT_EQ(where(s, 0, 0, 0), Side::inside);
  EXPECT_EQ(where(s, 0, 0, 4), Side::surface);
  EXPECT_EQ(where(s, 0, 0, 4.1), Side::outside);
  EXPECT_EQ(where(s, 3, 0, 4.9), Side::inside);
  EXPECT_EQ(where(s, 3, 0, 0.5), Side::outside) << "the hole";
}

TEST_F(GdmlOddSolids, TwistedTubesWithoutALengthAreNothing) {
  EXPECT_HAS(error_of(world_of("<twistedtubs name='s' endinnerrad='1' endouterrad='4' "
                               "twistedangle='1'/>")),
             "<twistedtubs name='s'>: a twisted tube needs zlen");
}

TEST_F(GdmlOddSolids, TwistedTubesOfHalfATurnAreRefusedWithTheirAngle) {
  const std::string tube =
      "<twistedtubs name='s' aunit='deg' twistedangle='20' endinnerrad='1' endouterrad='4' "
      "zlen='8' ";
  EXPECT_HAS(error_of(world_of(tube + "phi='180'/>")), "a twisted tube that spans 180 degrees");
  EXPECT_HAS(error_of(world_of(tube + "phi='250.5'/>")), "spans 250.5 degrees: it has to be");
  EXPECT_HAS(error_of(world_of(tube + "nseg='2' totphi='360'/>")), "spans 180 degrees");
  EXPECT_EQ(top(read(world_of(tube + "phi='179'/>"))).solid.kind, SolidKind::twistedtubs);
}

TEST_F(GdmlOddSolids, ReflectedSolidsAreScaledTurnedAndMoved) {
  const World world = read(world_of(
      "<box name='o' x='2' y='4' z='6'/><box name='p' x='2' y='2' z='2'/><union name='u'><first "
      "ref='o'/><second ref='p'/><position x='2'/></union><reflectedSolid name='s' solid='u' "
      "sx='-1' sy='1' sz='1' rz='90' aunit='deg' dx='1' lunit='cm'/>"));
  const Solid& s = top(world).solid;
  // The knob at x = 1..3 is at x = -3..-1, then at y = -3..-1, then at x = 10.
  EXPECT_EQ(where(s, 10, -2.9, 0), Side::inside);
  EXPECT_EQ(where(s, 10, 2.9, 0), Side::outside);
  EXPECT_EQ(where(s, 11.9, 0.9, 2.9), Side::inside);
}

}  // namespace
}  // namespace navjit::testing
