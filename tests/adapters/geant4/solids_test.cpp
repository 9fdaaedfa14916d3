// Every solid of Geant4 that navjit has a kernel for; both navigators walk through it.
#include <gtest/gtest.h>
#include <G4Box.hh>
#include <G4Cons.hh>
#include <G4CutTubs.hh>
#include <G4DisplacedSolid.hh>
#include <G4Ellipsoid.hh>
#include <G4EllipticalCone.hh>
#include <G4EllipticalTube.hh>
#include <G4ExtrudedSolid.hh>
#include <G4GenericPolycone.hh>
#include <G4GenericTrap.hh>
#include <G4Hype.hh>
#include <G4IntersectionSolid.hh>
#include <G4LogicalVolume.hh>
#include <G4MultiUnion.hh>
#include <G4Orb.hh>
#include <G4PVPlacement.hh>
#include <G4Para.hh>
#include <G4Paraboloid.hh>
#include <G4Polycone.hh>
#include <G4Polyhedra.hh>
#include <G4ReflectedSolid.hh>
#include <G4ScaledSolid.hh>
#include <G4Sphere.hh>
#include <G4SubtractionSolid.hh>
#include <G4TessellatedSolid.hh>
#include <G4Tet.hh>
#include <G4Torus.hh>
#include <G4Trap.hh>
#include <G4Trd.hh>
#include <G4TriangularFacet.hh>
#include <G4Tubs.hh>
#include <G4TwistedBox.hh>
#include <G4TwistedTrap.hh>
#include <G4TwistedTrd.hh>
#include <G4TwistedTubs.hh>
#include <G4UnionSolid.hh>

#include "tests/adapters/geant4/walk.hpp"

namespace navjit {
namespace {

/// The solids of a test.
struct Sample {
  const char* name;
  G4VSolid* (*make)();
  /// Steps that may differ. Geant4 takes points within 5e-10 mm of a surface as on it.
  double share = 5e-5;
};

G4VSolid* tessellated() {
  auto* solid = new G4TessellatedSolid("tessellated");
  const G4ThreeVector a(-20, -20, -20), b(30, -10, -20), c(0, 40, -15), d(5, 5, 40);
  solid->AddFacet(new G4TriangularFacet(a, c, b, ABSOLUTE));
  solid->AddFacet(new G4TriangularFacet(a, b, d, ABSOLUTE));
  solid->AddFacet(new G4TriangularFacet(b, c, d, ABSOLUTE));
  solid->AddFacet(new G4TriangularFacet(c, a, d, ABSOLUTE));
  solid->SetSolidClosed(true);
  return solid;
}

G4VSolid* polycone() {
  const double z[] = {-40, 0, 0, 40}, in[] = {5, 5, 10, 10}, out[] = {20, 30, 35, 25};
  return new G4Polycone("polycone", 0.3, 4.5, 4, z, in, out);
}

G4VSolid* polyhedra() {
  const double z[] = {-40, 10, 40}, in[] = {5, 8, 0}, out[] = {20, 30, 25};
  return new G4Polyhedra("polyhedra", 0.3, 4.5, 5, 3, z, in, out);
}

G4VSolid* generic_polycone() {
  const double r[] = {5, 30, 20, 10}, z[] = {-30, -20, 30, 35};
  return new G4GenericPolycone("generic", 0, 2 * M_PI, 4, r, z);
}

G4VSolid* generic_polyhedra() {
  const double r[] = {5, 30, 20, 10}, z[] = {-30, -20, 30, 35};
  return new G4Polyhedra("genericPolyhedra", 0.2, 2 * M_PI, 7, 4, r, z);
}

G4VSolid* multi_union() {
  auto* solid = new G4MultiUnion("multi");
  G4RotationMatrix turn;
  turn.rotateX(0.7);
  solid->AddNode(*new G4Box("part", 10, 20, 30), G4Transform3D(turn, {5, 0, 0}));
  solid->AddNode(*new G4Tubs("rod", 0, 8, 40, 0, 2 * M_PI), G4Transform3D());
  solid->Voxelize();
  return solid;
}

G4RotationMatrix* turned() {
  auto* turn = new G4RotationMatrix;
  turn->rotateX(0.4);
  turn->rotateZ(-1.1);
  return turn;
}

const Sample samples[] = {
    {"box", []() -> G4VSolid* { return new G4Box("box", 10, 20, 30); }},
    {"tubs", []() -> G4VSolid* { return new G4Tubs("tubs", 10, 30, 40, 0.3, 4); }},
    {"cons", []() -> G4VSolid* { return new G4Cons("cons", 5, 20, 10, 40, 30, 1, 5); }},
    {"cutTubs",
     []() -> G4VSolid* {
       return new G4CutTubs("cut", 10, 30, 40, 0, 2 * M_PI, G4ThreeVector(0.3, 0, -1).unit(),
                            G4ThreeVector(0, -0.2, 1).unit());
     }},
    {"trd", []() -> G4VSolid* { return new G4Trd("trd", 10, 20, 30, 15, 40); }},
    {"trap",
     []() -> G4VSolid* {
       return new G4Trap("trap", 40, 0.2, 0.3, 20, 10, 15, 0.1, 30, 15, 22.5, 0.1);
     }},
    {"para", []() -> G4VSolid* { return new G4Para("para", 10, 20, 30, 0.2, 0.3, 0.4); }},
    {"orb", []() -> G4VSolid* { return new G4Orb("orb", 35); }},
    {"sphere", []() -> G4VSolid* { return new G4Sphere("sphere", 20, 40, 0.2, 4, 0.5, 1.5); }},
    {"torus", []() -> G4VSolid* { return new G4Torus("torus", 3, 10, 30, 0.5, 5); }},
    {"ellipsoid", []() -> G4VSolid* { return new G4Ellipsoid("ell", 20, 30, 40, -20, 30); }},
    {"wholeEllipsoid", []() -> G4VSolid* { return new G4Ellipsoid("ell", 20, 30, 40); }},
    {"ellipticalTube", []() -> G4VSolid* { return new G4EllipticalTube("elt", 20, 30, 40); }},
    {"ellipticalCone", []() -> G4VSolid* { return new G4EllipticalCone("elc", 0.4, 0.6, 50, 25); }},
    {"paraboloid", []() -> G4VSolid* { return new G4Paraboloid("par", 30, 10, 35); }},
    {"hype", []() -> G4VSolid* { return new G4Hype("hype", 10, 20, 0.3, 0.5, 30); },
     // G4Hype::DistanceToIn misses the solid, or gives 0 off it, for one ray in a thousand.
     2e-3},
    {"twistedTubs", []() -> G4VSolid* { return new G4TwistedTubs("twt", 0.5, 10, 30, 35, 1.2); }},
    {"twistedBox", []() -> G4VSolid* { return new G4TwistedBox("twb", 0.5, 15, 20, 35); }},
    {"twistedTrd", []() -> G4VSolid* { return new G4TwistedTrd("twd", 10, 20, 15, 25, 35, 0.6); }},
    {"twistedTrap",
     []() -> G4VSolid* {
       return new G4TwistedTrap("twp", 0.5, 40, 0.1, 0.2, 20, 10, 15, 24, 12, 18, 0.1);
     }},
    {"polycone", polycone},
    {"polyhedra", polyhedra},
    {"genericPolycone", generic_polycone},
    {"genericPolyhedra", generic_polyhedra},
    {"extruded",
     []() -> G4VSolid* {
       return new G4ExtrudedSolid("xtru", {{-20, -20}, {-20, 20}, {0, 5}, {25, 20}, {20, -20}},
                                  {{-30, {0, 0}, 1}, {10, {5, 3}, 0.7}, {35, {0, 2}, 1.2}});
     }},
    {"tessellated", tessellated},
    {"tet",
     []() -> G4VSolid* {
       return new G4Tet("tet", {0, 0, 40}, {-30, -20, -20}, {30, -20, -20}, {0, 30, -25});
     }},
    {"genericTrap",
     []() -> G4VSolid* {
       return new G4GenericTrap("arb8", 30,
                                {{-20, -20},
                                 {-20, 20},
                                 {20, 20},
                                 {20, -20},
                                 {-10, -15},
                                 {-15, 10},
                                 {10, 15},
                                 {15, -10}});
     }},
    {"union",
     []() -> G4VSolid* {
       return new G4UnionSolid("union", new G4Box("a", 10, 20, 30), new G4Orb("b", 22), turned(),
                               {12, 3, -5});
     }},
    {"intersection",
     []() -> G4VSolid* {
       return new G4IntersectionSolid("common", new G4Box("a", 20, 20, 30),
                                      new G4Tubs("b", 5, 25, 50, 0, 2 * M_PI), turned(), {2, 3, 5});
     }},
    {"subtraction",
     []() -> G4VSolid* {
       return new G4SubtractionSolid("rest", new G4Box("a", 20, 25, 30),
                                     new G4Tubs("b", 0, 12, 50, 0, 2 * M_PI), turned(), {2, 3, 5});
     }},
    {"displaced",
     []() -> G4VSolid* {
       return new G4DisplacedSolid("moved", new G4Box("a", 10, 15, 20), turned(), {8, -3, 5});
     }},
    {"scaled",
     []() -> G4VSolid* {
       return new G4ScaledSolid("scaled", new G4Tubs("a", 5, 15, 20, 0.2, 4), G4Scale3D(1, 2, 1.5));
     }},
    {"reflected",
     []() -> G4VSolid* {
       const G4Transform3D turn(*turned(), {3, -4, 6});
       return new G4ReflectedSolid("mirrored", new G4Cons("a", 5, 20, 10, 30, 25, 1, 5),
                                   turn * G4ReflectX3D());
     }},
    {"multiUnion", multi_union},
};

class Solids : public testing::TestWithParam<Sample> {};

TEST_P(Solids, AreWalkedAlike) {
  auto* hall = new G4LogicalVolume(new G4Box("hall", 100, 100, 100), nullptr, "hall");
  auto* world = new G4PVPlacement(nullptr, {}, hall, "hall", nullptr, false, 0);
  auto* volume = new G4LogicalVolume(GetParam().make(), nullptr, "volume");
  new G4PVPlacement(turned(), {5, -3, 2}, volume, "placed", hall, false, 7);
  const tests::Walked walked =
      tests::walk(*world, {.tracks = 2000, .from = {-0.6, -0.6, -0.6}, .to = {0.6, 0.6, 0.6}});
  EXPECT_EQ(walked.refusal, "");
  const geant4::Differences& found = walked.counts.differences;
  EXPECT_GT(found.steps, 9000U);
  EXPECT_GT(walked.boundaries, 3000U);
  EXPECT_EQ(walked.without_normal, 0U);
  EXPECT_LE(static_cast<double>(found.lengths + found.histories),
            GetParam().share * static_cast<double>(found.steps));
  EXPECT_LT(found.largest_length, 1e-6);
  EXPECT_EQ(found.safeties, 0U);
}

INSTANTIATE_TEST_SUITE_P(Each, Solids, testing::ValuesIn(samples),
                         [](const auto& sample) { return std::string(sample.param.name); });

}  // namespace
}  // namespace navjit
