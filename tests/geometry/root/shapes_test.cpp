// ROOT's shapes as solids: kind, volume and extent, by formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "geometry/solids/any_solid.hpp"
#include "navjit/runtime.hpp"
#include "tests/support/root_reading.hpp"

namespace navjit {
namespace {

using namespace tests;
using std::numbers::pi;
using Numbers = std::vector<double>;

class RootShapes : public RootReading {
 protected:
  std::string refusal_of(const RootPointer& shape) { return refusal(root_world_around(shape)); }
};

/// `cm3` is the solid's volume. Extents are in cm.
void expect(const Solid& solid, SolidKind kind, double cm3, const Vec3& min, const Vec3& max) {
  EXPECT_STREQ(kind_name(solid.kind), kind_name(kind)) << solid.name;
  EXPECT_NEAR(capacity(solid) / 1000, cm3, 1e-9 * cm3) << solid.name;
  const Extent& e = solid.extent;
  const double found[] = {e.min.x, e.min.y, e.min.z, e.max.x, e.max.y, e.max.z};
  const double wanted[] = {min.x, min.y, min.z, max.x, max.y, max.z};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(found[i], 10 * wanted[i], 1e-6) << solid.name << i;
}

TEST_F(RootShapes, BoxesAndTubes) {
  expect(solid(root_box("box", 1, 2, 3)), SolidKind::box, 48, {-1, -2, -3}, {1, 2, 3});
  const RootPointer moved =
      root_object("TGeoBBox", "moved",
                  {{"fDX", 1.0}, {"fDY", 2.0}, {"fDZ", 3.0}, {"fOrigin", Numbers{4, 5, 6}}});
  const Solid there = solid(moved);
  EXPECT_EQ(there.extent.min.x, 30);
  EXPECT_EQ(there.extent.max.z, 90);

  expect(solid(root_object("TGeoTube", "tube", {{"fRmin", 1.0}, {"fRmax", 2.0}, {"fDz", 3.0}})),
         SolidKind::tube, pi * 3 * 6, {-2, -2, -3}, {2, 2, 3});
  // A quarter, beyond 360 degrees.
  expect(solid(root_object(
             "TGeoTubeSeg", "segment",
             {{"fRmin", 1.0}, {"fRmax", 2.0}, {"fDz", 3.0}, {"fPhi1", 270.0}, {"fPhi2", 360.0}})),
         SolidKind::tube, pi * 3 * 6 / 4, {0, -2, -3}, {2, 0, 3});
  const double half = std::sqrt(0.5);
  const Solid cut = solid(root_object("TGeoCtub", "cut",
                                      {{"fRmin", 0.0},
                                       {"fRmax", 2.0},
                                       {"fDz", 3.0},
                                       {"fPhi1", 0.0},
                                       {"fPhi2", 360.0},
                                       {"fNlow", Numbers{0, 0, -1}},
                                       {"fNhigh", Numbers{half, 0, half}}}));
  expect(cut, SolidKind::cut_tube, pi * 4 * 6, {-2, -2, -3}, {2, 2, 5});
  expect(solid(root_object("TGeoEltu", "ellipse", {{"fRmin", 1.0}, {"fRmax", 2.0}, {"fDz", 3.0}})),
         SolidKind::eltube, pi * 2 * 6, {-1, -2, -3}, {1, 2, 3});
}

TEST_F(RootShapes, ConesAndContours) {
  const std::vector<std::pair<std::string, RootValue>> cone{
      {"fDz", 3.0}, {"fRmin1", 0.0}, {"fRmax1", 1.0}, {"fRmin2", 0.0}, {"fRmax2", 2.0}};
  expect(solid(root_object("TGeoCone", "cone", cone)), SolidKind::cone, pi * 2 * (1 + 2 + 4),
         {-2, -2, -3}, {2, 2, 3});
  auto segment = cone;
  segment.emplace_back("fPhi1", 0.0);
  segment.emplace_back("fPhi2", 180.0);
  expect(solid(root_object("TGeoConeSeg", "half", segment)), SolidKind::cone, pi * (1 + 2 + 4),
         {-2, 0, -3}, {2, 2, 3});
  const std::vector<std::pair<std::string, RootValue>> planes{
      {"fPhi1", 0.0},
      {"fDphi", 360.0},
      {"fRmin", RootCounted{"fNz", {0, 0, 0}}},
      {"fRmax", RootCounted{"", {1, 1, 2}}},
      {"fZ", RootCounted{"", {-1, 0, 1}}}};
  expect(solid(root_object("TGeoPcon", "polycone", planes)), SolidKind::polycone,
         pi * (1 + 7.0 / 3), {-2, -2, -1}, {2, 2, 1});
  // Four sides at those distances from the axis: the first edge is at azimuth 0.
  auto sides = planes;
  sides.emplace_back("fNedges", 4);
  expect(solid(root_object("TGeoPgon", "polyhedra", sides)), SolidKind::polyhedra,
         4 * (1 + 7.0 / 3), {-2 * std::sqrt(2), -2 * std::sqrt(2), -1},
         {2 * std::sqrt(2), 2 * std::sqrt(2), 1});
}

TEST_F(RootShapes, FlatSides) {
  expect(solid(root_object("TGeoTrd1", "trd1",
                           {{"fDx1", 1.0}, {"fDx2", 2.0}, {"fDy", 3.0}, {"fDz", 4.0}})),
         SolidKind::trd, 3 * 6 * 8, {-2, -3, -4}, {2, 3, 4});
  expect(solid(root_object(
             "TGeoTrd2", "trd2",
             {{"fDx1", 1.0}, {"fDx2", 2.0}, {"fDy1", 3.0}, {"fDy2", 3.0}, {"fDz", 4.0}})),
         SolidKind::trd, 3 * 6 * 8, {-2, -3, -4}, {2, 3, 4});
  const double lean = std::tan(pi / 6);
  expect(solid(root_object("TGeoPara", "para",
                           {{"fX", 1.0},
                            {"fY", 2.0},
                            {"fZ", 3.0},
                            {"fAlpha", 0.0},
                            {"fTheta", 30.0},
                            {"fPhi", 90.0}})),
         SolidKind::trap, 48, {-1, -2 - 3 * lean, -3}, {1, 2 + 3 * lean, 3});

  // Only tangents matter: 210 degrees lean as 30 do.
  expect(solid(root_object("TGeoPara", "turned",
                           {{"fX", 1.0},
                            {"fY", 2.0},
                            {"fZ", 3.0},
                            {"fAlpha", 180.0},
                            {"fTheta", 210.0},
                            {"fPhi", 90.0}})),
         SolidKind::trap, 48, {-1, -2 - 3 * lean, -3}, {1, 2 + 3 * lean, 3});

  // Corners are those of the base class; the trap's own numbers say the same.
  const auto arb8 = [](const Numbers& corners) {
    return root_object("TGeoArb8", "", {{"fDz", 3.0}, {"fXY", corners}});
  };
  const Numbers square{-1, -2, -1, 2, 1, 2, 1, -2, -1, -2, -1, 2, 1, 2, 1, -2};
  const Numbers wedge{-1, -2, -1, -2, 1, 2, 1, -2, -1, -2, -1, -2, 1, 2, 1, -2};
  EXPECT_NEAR(capacity(solid(arb8(square))), 48e3, 1e-6);
  EXPECT_NEAR(capacity(solid(arb8(wedge))), 24e3, 1e-6);
  const auto trap = [&](const std::string& type, const Numbers& corners, double edge,
                        double twist) {
    std::vector<std::pair<std::string, RootValue>> members{{"TGeoArb8", RootBase{arb8(corners)}},
                                                           {"fTheta", 0.0},
                                                           {"fPhi", 0.0},
                                                           {"fH1", 2.0},
                                                           {"fBl1", 1.0},
                                                           {"fTl1", edge},
                                                           {"fAlpha1", 0.0},
                                                           {"fH2", 2.0},
                                                           {"fBl2", 1.0},
                                                           {"fTl2", edge},
                                                           {"fAlpha2", 0.0}};
    if (type == "TGeoGtra") members.emplace_back("fTwistAngle", twist);
    const RootPointer it = root_object(type, "trap", members);
    it->named = false;
    return it;
  };
  EXPECT_NEAR(capacity(solid(trap("TGeoTrap", square, 1, 0))), 48e3, 1e-6);
  EXPECT_NEAR(capacity(solid(trap("TGeoGtra", square, 1, 0))), 48e3, 1e-6);
  // An edge without length: from the corners alone.
  EXPECT_NEAR(capacity(solid(trap("TGeoTrap", wedge, 0, 0))), 24e3, 1e-6);
  Numbers twisted = square;
  const double angle = pi / 9;
  for (std::size_t i = 8; i < 16; i += 2) {
    const double x = square[i], y = square[i + 1];
    twisted[i] = x * std::cos(angle) - y * std::sin(angle);
    twisted[i + 1] = x * std::sin(angle) + y * std::cos(angle);
  }
  EXPECT_STREQ(kind_name(solid(trap("TGeoGtra", twisted, 1, 20)).kind), "arb8");
}

TEST_F(RootShapes, RoundOnes) {
  const auto sphere = [](double theta1, double theta2, double phi1, double phi2) {
    return root_object("TGeoSphere", "sphere",
                       {{"fRmin", 0.0},
                        {"fRmax", 3.0},
                        {"fTheta1", theta1},
                        {"fTheta2", theta2},
                        {"fPhi1", phi1},
                        {"fPhi2", phi2}});
  };
  const double ball = 4 * pi / 3 * 27;
  expect(solid(sphere(0, 180, 0, 360)), SolidKind::orb, ball, {-3, -3, -3}, {3, 3, 3});
  expect(solid(sphere(0, 90, 0, 90)), SolidKind::sphere, ball / 8, {0, 0, 0}, {3, 3, 3});
  expect(solid(root_object(
             "TGeoTorus", "torus",
             {{"fR", 5.0}, {"fRmin", 0.0}, {"fRmax", 1.0}, {"fPhi1", 0.0}, {"fDphi", 360.0}})),
         SolidKind::torus, 2 * pi * pi * 5, {-6, -6, -1}, {6, 6, 1});
  const double tangent = std::tan(pi / 6);
  const double far = std::sqrt(4 + 9 * tangent * tangent);
  expect(solid(root_object(
             "TGeoHype", "hype",
             {{"fRmin", 0.0}, {"fRmax", 2.0}, {"fDz", 3.0}, {"fStIn", 0.0}, {"fStOut", 30.0}})),
         SolidKind::hype, pi * (6 * 4 + 2 * 27 * tangent * tangent / 3), {-far, -far, -3},
         {far, far, 3});
  expect(solid(root_object("TGeoParaboloid", "bowl", {{"fRlo", 1.0}, {"fRhi", 2.0}, {"fDz", 3.0}})),
         SolidKind::paraboloid, pi * 6 * 2.5, {-2, -2, -3}, {2, 2, 3});
  const Solid dome =
      solid(root_object("TGeoParaboloid", "dome", {{"fRlo", 2.0}, {"fRhi", 1.0}, {"fDz", 3.0}}));
  expect(dome, SolidKind::scaled, pi * 6 * 2.5, {-2, -2, -3}, {2, 2, 3});
  const auto up = kernels::make_direction<double>(0, 0, 1);
  EXPECT_TRUE(contains(dome.any(), {19, 0, -29}, up, 1e-9));
  EXPECT_FALSE(contains(dome.any(), {19, 0, 29}, up, 1e-9));
}

TEST_F(RootShapes, ExtrudedOnesMayHaveSteps) {
  const auto extruded = [](const Numbers& z, const Numbers& scale) {
    const Numbers none(z.size(), 0.0);
    return root_object("TGeoXtru", "extruded",
                       {{"fNvert", 4},
                        {"fX", Numbers{-1, 1, 1, -1}},
                        {"fY", Numbers{-1, -1, 1, 1}},
                        {"fZ", RootCounted{"fNz", z}},
                        {"fScale", RootCounted{"", scale}},
                        {"fX0", RootCounted{"", none}},
                        {"fY0", RootCounted{"", none}}});
  };
  EXPECT_NEAR(capacity(solid(extruded({-3, 3}, {1, 1}))), 24e3, 1e-6);
  // A smaller part upon a larger one, as points find it.
  const Detector detector = read(root_world_around(extruded({-3, 0, 0, 3}, {2, 2, 1, 1})));
  Runtime runtime{detector, {.jit = JitMode::off}};
  Navigator navigator = runtime.navigator();
  const auto within = [&](const Vec3& p) { return detector.depth(navigator.locate(p)) == 1; };
  EXPECT_TRUE(within({15, 0, -10}));
  EXPECT_FALSE(within({15, 0, 10}));
  EXPECT_TRUE(within({5, 0, 10}));
}

TEST_F(RootShapes, WhatCannotBeIsRefusedByName) {
  for (const auto& [shape, what] : std::initializer_list<std::pair<RootPointer, const char*>>{
           {root_box("inverted", 1, -2, 1), "TGeoBBox 'inverted': "},
           {root_box("endless", 1, INFINITY, 1), "fDY is no finite number"},
           {root_object("TGeoShapeOfOthers", "odd", {}), "TGeoShapeOfOthers 'odd': unsupported"},
           {root_object("TGeoTube", "pipe", {{"fRmin", 0.0}}), "it has no number f"},
           {root_boolean("TGeoUnion", root_box("a", 1, 1, 1), {}), "it lacks an operand"}}) {
    const std::string message = refusal_of(shape);
    EXPECT_TRUE(message.starts_with(file_ + ": ")) << message;
    EXPECT_NE(message.find(what), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace navjit
