// Tori, solids behind quadrics and twisted solids: the makers get GDML's dimensions in their own
// units. Some elements give whole lengths, others half lengths.
#include <cmath>
#include <numbers>

#include "tests/geometry/gdml/gdml_files.hpp"

namespace navjit::testing {
namespace {

class GdmlCurvedSolids : public GdmlFiles {
 protected:
  /// The solid of this text, which must be named 's'.
  Solid solid(const std::string& text) const {
    return top(read(Gdml{.solids = text,
                         .structure = "<volume name='W'><materialref ref='G4_AIR'/><solidref "
                                      "ref='s'/></volume>"}))
        .solid;
  }
};

void expect_extent(const Solid& s, double x, double y, double z) {
  EXPECT_NEAR(s.extent.max.x, x, 1e-5 * x);
  EXPECT_NEAR(s.extent.max.y, y, 1e-5 * y);
  EXPECT_NEAR(s.extent.max.z, z, 1e-9);
}

TEST_F(GdmlCurvedSolids, HaveTheirDimensions) {
  const Solid torus = solid(
      "<torus name='s' rmin='1' rmax='2' rtor='5' deltaphi='360' "
      "aunit='deg' lunit='cm'/>");
  EXPECT_EQ(torus.kind, SolidKind::torus);
  expect_extent(torus, 70, 70, 20);
  expect_extent(solid("<ellipsoid name='s' ax='1' by='2' cz='3' lunit='cm'/>"), 10, 20, 30);
  expect_extent(solid("<ellipsoid name='s' ax='1' by='2' cz='3' zcut1='-1' zcut2='2'/>"), 1, 2, 2);
  // What is missing cuts nothing, as the schema has it.
  expect_extent(solid("<ellipsoid name='s' ax='1' by='2' cz='3' zcut2='2'/>"), 1, 2, 2);
  EXPECT_EQ(solid("<ellipsoid name='s' ax='1' by='2' cz='3' zcut2='2'/>").extent.min.z, -3);
  EXPECT_EQ(solid("<ellipsoid name='s' ax='1' by='2' cz='3' zcut1='-2'/>").extent.min.z, -2);
  EXPECT_EQ(solid("<ellipsoid name='s' ax='1' by='2' cz='3' zcut1='-2'/>").extent.max.z, 3);
  expect_extent(solid("<eltube name='s' dx='1' dy='2' dz='3' lunit='cm'/>"), 10, 20, 30);
  expect_extent(solid("<elcone name='s' dx='1' dy='2' zmax='3' zcut='1' lunit='cm'/>"), 40, 80, 10);
  expect_extent(solid("<paraboloid name='s' rlo='1' rhi='2' dz='3' lunit='cm'/>"), 20, 20, 30);
  expect_extent(solid("<hype name='s' rmin='1' rmax='3' z='8' inst='0' outst='45' aunit='deg'/>"),
                5, 5, 4);
}

TEST_F(GdmlCurvedSolids, Twist) {
  const double c = std::cos(0.5), n = std::sin(0.5);
  const Solid box = solid("<twistedbox name='s' PhiTwist='1' x='2' y='4' z='6'/>");
  EXPECT_EQ(box.kind, SolidKind::twistedbox);
  // On the way a corner passes the y axis.
  expect_extent(box, c + 2 * n, std::sqrt(5.0), 3);
  const Solid trd = solid("<twistedtrd name='s' PhiTwist='1' x1='2' x2='2' y1='4' y2='4' z='6'/>");
  expect_extent(trd, box.extent.max.x, box.extent.max.y, 3);
  const Solid trap = solid(
      "<twistedtrap name='s' PhiTwist='1' z='6' Theta='0' Phi='0' y1='4' x1='2' x2='2' "
      "y2='4' x3='2' x4='2' Alph='0'/>");
  expect_extent(trap, box.extent.max.x, box.extent.max.y, 3);
  const Solid tube = solid(
      "<twistedtubs name='s' twistedangle='60' endinnerrad='1' "
      "endouterrad='2' zlen='4' phi='90' aunit='deg' lunit='cm'/>");
  EXPECT_EQ(tube.kind, SolidKind::twistedtubs);
  expect_extent(tube, 20, 20 * std::sin(75 * std::numbers::pi / 180), 20);
  const Solid other = solid(
      "<twistedtubs name='s' twistedangle='60' midinnerrad='1' midouterrad='2' "
      "negativeEndz='-2' positiveEndz='2' nseg='4' totphi='360' aunit='deg'/>");
  EXPECT_EQ(kernels::inside(other.any(), Vec3{1.0, 0.0, 0.0}, 1e-9), Side::surface);
  EXPECT_EQ(kernels::inside(other.any(), Vec3{2.0, 0.0, 0.0}, 1e-9), Side::surface);
}

}  // namespace
}  // namespace navjit::testing
