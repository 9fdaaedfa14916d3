// Solids that navjit has no kernel for: Geant4 answers for them, and navjit navigates the world
// nevertheless.
#include <gtest/gtest.h>
#include <G4AffineTransform.hh>
#include <G4Box.hh>
#include <G4IntersectionSolid.hh>
#include <G4LogicalVolume.hh>
#include <G4PVParameterised.hh>
#include <G4PVPlacement.hh>
#include <G4ReflectedSolid.hh>
#include <G4SubtractionSolid.hh>
#include <G4Tubs.hh>
#include <G4VGraphicsScene.hh>
#include <G4VPVParameterisation.hh>
#include <G4VoxelLimits.hh>
#include <sstream>

#include "navjit/geant4/use.hpp"
#include "tests/adapters/geant4/walk.hpp"

namespace navjit {
namespace {

/// A user's class with only what the base class demands. It stands for the solid that it holds.
class Wrapped : public G4VSolid {
 public:
  explicit Wrapped(const G4VSolid* of) : G4VSolid("own_" + of->GetName()), of_(of) {}

  G4bool CalculateExtent(const EAxis axis, const G4VoxelLimits& limits,
                         const G4AffineTransform& transform, G4double& low,
                         G4double& high) const override {
    return of_->CalculateExtent(axis, limits, transform, low, high);
  }
  EInside Inside(const G4ThreeVector& p) const override { return of_->Inside(p); }
  G4ThreeVector SurfaceNormal(const G4ThreeVector& p) const override {
    return of_->SurfaceNormal(p);
  }
  G4double DistanceToIn(const G4ThreeVector& p, const G4ThreeVector& v) const override {
    return of_->DistanceToIn(p, v);
  }
  G4double DistanceToIn(const G4ThreeVector& p) const override { return of_->DistanceToIn(p); }
  G4double DistanceToOut(const G4ThreeVector& p, const G4ThreeVector& v, const G4bool with_normal,
                         G4bool* valid, G4ThreeVector* normal) const override {
    return of_->DistanceToOut(p, v, with_normal, valid, normal);
  }
  G4double DistanceToOut(const G4ThreeVector& p) const override { return of_->DistanceToOut(p); }
  G4GeometryType GetEntityType() const override { return "Wrapped"; }
  std::ostream& StreamInfo(std::ostream& out) const override { return of_->StreamInfo(out); }
  void DescribeYourselfTo(G4VGraphicsScene& scene) const override {
    of_->DescribeYourselfTo(scene);
  }

 private:
  const G4VSolid* of_;
};

/// A class of Geant4's that a user changed: navjit must recognise only the exact class of Geant4.
class Lower : public G4Box {
 public:
  using G4Box::G4Box;
  G4VSolid* Clone() const override { return new Lower(*this); }
};

struct Hall {
  G4LogicalVolume* volume = new G4LogicalVolume(new G4Box("hall", 200, 200, 200), nullptr, "hall");
  G4VPhysicalVolume* world = new G4PVPlacement(nullptr, {}, volume, "hall", nullptr, false, 0);

  G4LogicalVolume* place(G4VSolid* solid, const G4ThreeVector& at, double turn = 0) const {
    auto* rotation = new G4RotationMatrix;
    rotation->rotateX(turn);
    auto* daughter = new G4LogicalVolume(solid, nullptr, solid->GetName());
    new G4PVPlacement(rotation, at, daughter, solid->GetName(), volume, false, 3);
    return daughter;
  }
};

TEST(OwnSolids, AreAskedThemselves) {
  const Hall hall;
  G4LogicalVolume* tube =
      hall.place(new Wrapped(new G4Tubs("tube", 20, 60, 50, 0.3, 4)), {-90, 20, 0}, 0.4);
  new G4PVPlacement(nullptr, {-35, 5, 4},
                    new G4LogicalVolume(new Lower("chip", 3, 4, 5), nullptr, "chip"), "chip", tube,
                    false, 0);
  G4LogicalVolume* box = hall.place(new Lower("lower", 30, 40, 50), {90, 20, 0});
  // Its daughter shares two faces with it.
  new G4PVPlacement(
      nullptr, {10, 0, 20},
      new G4LogicalVolume(new Wrapped(new G4Box("corner", 20, 30, 30)), nullptr, "corner"),
      "corner", box, false, 0);
  tests::expect_alike(*hall.world);
}

TEST(OwnSolids, ArePartsOfOthers) {
  const Hall hall;
  auto* block = new G4Box("block", 40, 40, 40);
  auto* bore = new Wrapped(new G4Tubs("bore", 0, 25, 60, 0, 2 * M_PI));
  auto* turn = new G4RotationMatrix;
  turn->rotateX(0.7);
  hall.place(new G4SubtractionSolid("bored", block, bore, turn, {5, 3, 0}), {-100, 0, 0}, 0.2);
  hall.place(new G4IntersectionSolid("core", block, bore, turn, {5, 3, 0}), {0, 0, 0}, 0.2);
  hall.place(new G4ReflectedSolid("mirrored", bore, G4ReflectX3D() * G4TranslateX3D(12)),
             {100, 0, 0}, 0.2);
  tests::expect_alike(*hall.world);
}

/// Bricks whose size grows from copy to copy.
class Bricks : public G4VPVParameterisation {
 public:
  void ComputeTransformation(const G4int copy, G4VPhysicalVolume* volume) const override {
    volume->SetTranslation({0, 0, -90.0 + 30 * copy});
  }
  void ComputeDimensions(G4Box& solid, const G4int copy, const G4VPhysicalVolume*) const override {
    solid.SetXHalfLength(20.0 + 5 * copy);
    solid.SetYHalfLength(15.0 + 4 * copy);
    solid.SetZHalfLength(12);
  }
};

TEST(OwnSolids, OfCopiesThatDiffer) {
  const Hall hall;
  auto* brick = new G4LogicalVolume(new Lower("brick", 1, 2, 3), nullptr, "brick");
  new G4PVParameterised("bricks", brick, hall.volume, kZAxis, 7, new Bricks);
  tests::expect_alike(*hall.world);
  const geant4::Geometry geometry(*hall.world);
  EXPECT_EQ(geometry.asked_of_geant4().size(), 7U);
  EXPECT_EQ(geometry.asked_of_geant4()[0], "brick");
}

/// A user's class that inherits Clone() from the box: its clone is only a box.
class Uncloned : public G4Box {
 public:
  using G4Box::G4Box;
};

TEST(OwnSolids, OfCopiesThatDifferNeedACloneOfTheirOwn) {
  const Hall hall;
  auto* brick = new G4LogicalVolume(new Uncloned("brick", 1, 2, 3), nullptr, "brick");
  new G4PVParameterised("bricks", brick, hall.volume, kZAxis, 7, new Bricks);
  try {
    const geant4::Geometry geometry(*hall.world);
    FAIL() << "it was converted";
  } catch (const geant4::Unsupported& error) {
    EXPECT_NE(std::string(error.what()).find("volume 'brick'"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("Clone()"), std::string::npos) << error.what();
  }
}

TEST(OwnSolids, AreNamedInTheReport) {
  const Hall hall;
  hall.place(new Lower("lower", 30, 40, 50), {90, 20, 0});
  geant4::Session session({});
  ASSERT_NE(session.engine(*hall.world), nullptr);
  std::ostringstream report;
  geant4::print_report(session, report);
  EXPECT_NE(report.str().find("Geant4's own solids were asked in 1 volume: lower"),
            std::string::npos)
      << report.str();
}

}  // namespace
}  // namespace navjit
