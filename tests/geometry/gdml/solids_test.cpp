// Every supported solid: the makers get GDML's dimensions in their own units.
#include <cmath>
#include <numbers>

#include "tests/geometry/gdml/gdml_files.hpp"

namespace navjit::testing {
namespace {

constexpr double pi = std::numbers::pi;

class GdmlSolids : public GdmlFiles {
 protected:
  /// The solid of this text, which must be named 's'.
  Solid solid(const std::string& text, const std::string& define = "") const {
    return top(read(Gdml{.define = define,
                         .solids = text,
                         .structure = "<volume name='W'><materialref ref='G4_AIR'/><solidref "
                                      "ref='s'/></volume>"}))
        .solid;
  }
  static bool has(const Solid& s, double x, double y, double z) {
    return kernels::inside(s.any(), Vec3{x, y, z}, 1e-9) == Side::inside;
  }
};

void expect_extent(const Solid& s, double x, double y, double z) {
  EXPECT_NEAR(s.extent.max.x, x, 1e-9);
  EXPECT_NEAR(s.extent.max.y, y, 1e-9);
  EXPECT_NEAR(s.extent.max.z, z, 1e-9);
}

TEST_F(GdmlSolids, Primitives) {
  const Solid box = solid("<box name='s' x='2' y='4' z='6' lunit='cm'/>");
  EXPECT_EQ(box.kind, SolidKind::box);
  EXPECT_EQ(box.name, "s");
  expect_extent(box, 10, 20, 30);

  const Solid tube = solid(
      "<tube name='s' rmin='1' rmax='2' z='3' startphi='0' deltaphi='90' aunit='deg' lunit='m'/>");
  EXPECT_EQ(tube.kind, SolidKind::tube);
  expect_extent(tube, 2000, 2000, 1500);
  EXPECT_TRUE(has(tube, 1100, 1000, 1400));
  EXPECT_FALSE(has(tube, -1100, 1000, 1400));
  EXPECT_FALSE(has(tube, 500, 500, 0));

  const Solid cone =
      solid("<cone name='s' rmin1='1' rmax1='2' rmin2='3' rmax2='4' z='10' deltaphi='twopi'/>");
  expect_extent(cone, 4, 4, 5);
  EXPECT_TRUE(has(cone, 1.6, 0, -4.9));
  EXPECT_FALSE(has(cone, 1.6, 0, 4.9));
  EXPECT_TRUE(has(cone, 3.5, 0, 4.9));

  const Solid trd = solid("<trd name='s' x1='2' x2='4' y1='6' y2='8' z='10'/>");
  expect_extent(trd, 2, 4, 5);
  EXPECT_FALSE(has(trd, 1.5, 0, -4.9));
  EXPECT_TRUE(has(trd, 1.5, 0, 4.9));

  const Solid trap = solid(
      "<trap name='s' z='10' theta='0' phi='0' y1='6' x1='2' x2='4' alpha1='0' y2='6' x3='2' "
      "x4='4' alpha2='0'/>");
  expect_extent(trap, 2, 3, 5);
  EXPECT_TRUE(has(trap, 1.5, 2.9, 0));
  EXPECT_FALSE(has(trap, 1.5, -2.9, 0));

  EXPECT_TRUE(has(solid("<orb name='s' r='5' lunit='cm'/>"), 28, 28, 28));
  const Solid sphere = solid(
      "<sphere name='s' rmin='4' rmax='5' deltaphi='360' starttheta='0' deltatheta='90' "
      "aunit='degree'/>");
  EXPECT_TRUE(has(sphere, 0, 0, 4.5));
  EXPECT_FALSE(has(sphere, 0, 0, -4.5));
  EXPECT_FALSE(has(sphere, 0, 0, 3));

  const std::string planes =
      "<zplane z='-1' rmin='0.5' rmax='2'/><zplane z='1' rmin='0.5' rmax='3'/>";
  const Solid polycone =
      solid("<polycone name='s' deltaphi='2*pi' lunit='cm'>" + planes + "</polycone>");
  expect_extent(polycone, 30, 30, 10);
  EXPECT_FALSE(has(polycone, 4, 0, 0));
  EXPECT_TRUE(has(polycone, 24, 0, 0));

  // Radii of polyhedra are those of the sides, not of the edges: here 45 degrees apart.
  const Solid polyhedra =
      solid("<polyhedra name='s' startphi='0' deltaphi='360' numsides='4' aunit='deg' lunit='cm'>" +
            planes + "</polyhedra>");
  expect_extent(polyhedra, 30 * std::sqrt(2), 30 * std::sqrt(2), 10);
  EXPECT_TRUE(has(polyhedra, 35, 0, 9.9));
}

TEST_F(GdmlSolids, BooleansPlaceTheSecondSolidActively) {
  const std::string bar = "<box name='bar' x='40' y='2' z='2'/>";
  const auto with = [&](const std::string& frame) {
    return solid(bar + "<union name='s'><first ref='b'/><second ref='bar'/>" + frame + "</union>");
  };
  // The bar reaches 20 along its x. Turned actively by +30 degrees about z, it points up.
  const Solid turned = with("<rotation z='30' unit='deg'/>");
  const double x = 18 * std::cos(pi / 6), y = 18 * std::sin(pi / 6);
  EXPECT_TRUE(has(turned, x, y, 0));
  EXPECT_FALSE(has(turned, x, -y, 0));
  // First about x by 90 degrees, then about y by -90: the bar's x axis becomes z.
  const Solid twice = with("<rotation x='90' y='-90' unit='deg'/><position y='5'/>");
  EXPECT_TRUE(has(twice, 0, 5, 18));
  EXPECT_FALSE(has(twice, 0, 5.0, 21));
  EXPECT_FALSE(has(twice, 18, 5, 0));
  // Order: about x, then y, then z. Of the bar's x axis: rotation by y first moves it to -z.
  const Solid thrice = with("<rotation x='90' y='90' z='90' unit='deg'/>");
  EXPECT_TRUE(has(thrice, 0, 0, -18));
  // The same angles place a physvol by the inverse.
  const Solid shifted = with("<position x='30' unit='mm'/>");
  EXPECT_TRUE(has(shifted, 45, 0, 0));
  EXPECT_FALSE(has(shifted, -15, 0, 0));
}

TEST_F(GdmlSolids, BooleansPlaceTheFirstSolidToo) {
  const std::string bar = "<box name='bar' x='40' y='2' z='2'/>";
  const Solid s = solid(bar +
                            "<subtraction name='s'><first ref='bar'/><second ref='b'/>"
                            "<firstposition x='20'/><firstrotationref ref='r'/>"
                            "<positionref ref='p'/></subtraction>",
                        "<rotation name='r' z='90' unit='deg'/><position name='p' x='20' y='15'/>");
  EXPECT_TRUE(has(s, 20, -18, 0));
  EXPECT_FALSE(has(s, 20, 18, 0)) << "taken away";
  EXPECT_FALSE(has(s, 0, 0, 0));
}

TEST_F(GdmlSolids, Intersections) {
  const Solid s = solid(
      "<intersection name='s'><first ref='b'/><second ref='b'/><position x='15'/></intersection>");
  EXPECT_TRUE(has(s, 7, 0, 0));
  EXPECT_FALSE(has(s, 4, 0, 0));
  EXPECT_FALSE(has(s, 12, 0, 0));
}

TEST_F(GdmlSolids, BooleansOfTheAllowedDepth) {
  std::string chain = "<box name='u0' x='1' y='1' z='1'/>";
  for (int i = 1; i < 200; ++i) {
    const std::string name = i == 199 ? "s" : "u" + std::to_string(i);
    chain += "<union name='" + name + "'><first ref='u" + std::to_string(i - 1) +
             "'/><second ref='b'/><position x='" + std::to_string(30 * i) + "'/></union>";
  }
  const Solid s = solid(chain);
  EXPECT_TRUE(has(s, 0, 0, 0));
  EXPECT_TRUE(has(s, 30 * 199, 0, 0));
  EXPECT_FALSE(has(s, 15, 0, 0));
}

/// A plate of hundreds of holes, cut one after the other, is one solid less one union of few
/// levels.
TEST_F(GdmlSolids, ChainsMayBeLongerThanBooleansMayBeDeep) {
  std::string chain = "<box name='u0' x='20000' y='10' z='10'/>";
  constexpr int holes = 600;
  for (int i = 1; i <= holes; ++i) {
    const std::string name = i == holes ? "s" : "u" + std::to_string(i);
    chain += "<subtraction name='" + name + "'><first ref='u" + std::to_string(i - 1) +
             "'/><second ref='b'/><position x='" + std::to_string(30 * (i - holes / 2)) +
             "'/></subtraction>";
  }
  const Solid s = solid(chain);
  EXPECT_FALSE(has(s, 30 * (1 - holes / 2), 0, 0));
  EXPECT_FALSE(has(s, 30 * holes / 2, 0, 0));
  EXPECT_TRUE(has(s, 15, 0, 0));
}

}  // namespace
}  // namespace navjit::testing
