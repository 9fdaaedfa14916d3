// Replicas, divisions, parameterised volumes, assemblies and reflections that are made in code.
#include <gtest/gtest.h>
#include <G4AssemblyVolume.hh>
#include <G4Box.hh>
#include <G4Cons.hh>
#include <G4LogicalVolume.hh>
#include <G4Material.hh>
#include <G4PVDivision.hh>
#include <G4PVParameterised.hh>
#include <G4PVPlacement.hh>
#include <G4PVReplica.hh>
#include <G4ReflectionFactory.hh>
#include <G4SystemOfUnits.hh>
#include <G4TouchableHistory.hh>
#include <G4Tubs.hh>
#include <G4VPVParameterisation.hh>

#include "navjit/geant4/navigator.hpp"
#include "tests/adapters/geant4/walk.hpp"

namespace navjit {
namespace {

G4LogicalVolume* box(const char* name, double x, double y, double z,
                     G4Material* material = nullptr) {
  return new G4LogicalVolume(new G4Box(name, x, y, z), material, name);
}

G4LogicalVolume* tube(const char* name, double rmin, double rmax, double z, double phi = 2 * M_PI) {
  return new G4LogicalVolume(new G4Tubs(name, rmin, rmax, z, 0, phi), nullptr, name);
}

struct Hall {
  G4LogicalVolume* volume = box("hall", 200, 200, 200);
  G4VPhysicalVolume* world = new G4PVPlacement(nullptr, {}, volume, "hall", nullptr, false, 0);

  void place(G4LogicalVolume* daughter, const G4ThreeVector& at, double turn = 0) const {
    auto* rotation = new G4RotationMatrix;
    rotation->rotateX(turn);
    new G4PVPlacement(rotation, at, daughter, daughter->GetName(), volume, false, 3);
  }
};

TEST(Replicas, OfABoxAlongItsAxes) {
  const Hall hall;
  auto* calorimeter = box("calorimeter", 100, 100, 100);
  hall.place(calorimeter, {10, -5, 3}, 0.3);
  auto* layer = box("layer", 100, 100, 10);
  new G4PVReplica("layer", layer, calorimeter, kZAxis, 10, 20);
  auto* strip = box("strip", 12.5, 100, 10);
  new G4PVReplica("strip", strip, layer, kXAxis, 8, 25);
  new G4PVPlacement(nullptr, {0, 0, -5}, box("absorber", 12.5, 100, 5), "absorber", strip, false,
                    0);
  new G4PVPlacement(nullptr, {0, 0, 3}, box("gap", 10, 90, 2), "gap", strip, false, 1);
  tests::expect_alike(*hall.world);
}

TEST(Replicas, OfATubeInAzimuth) {
  const Hall hall;
  auto* drum = tube("drum", 20, 150, 100);
  hall.place(drum, {0, 10, 0}, 0.5);
  auto* wedge = new G4LogicalVolume(new G4Tubs("wedge", 20, 150, 100, -M_PI / 12, M_PI / 6),
                                    nullptr, "wedge");
  new G4PVReplica("wedge", wedge, drum, kPhi, 12, M_PI / 6);
  new G4PVPlacement(nullptr, {80, 0, 0}, box("crystal", 30, 8, 60), "crystal", wedge, false, 0);
  tests::expect_alike(*hall.world);
}

TEST(Replicas, OfATubeAlongTheRadius) {
  const Hall hall;
  auto* drum = tube("drum", 0, 120, 100);
  hall.place(drum, {0, 10, 0}, 0.5);
  new G4PVReplica("ring", tube("ring", 0, 20, 100), drum, kRho, 6, 20);
  tests::expect_alike(*hall.world);
}

TEST(Divisions, OfBoxAndCone) {
  const Hall hall;
  auto* block = box("block", 60, 50, 80);
  hall.place(block, {-80, 10, 0}, 0.4);
  new G4PVDivision("slice", box("slice", 15, 50, 80), block, kXAxis, 4, 0);
  auto* cone =
      new G4LogicalVolume(new G4Cons("cone", 10, 60, 20, 80, 90, 0, 2 * M_PI), nullptr, "cone");
  hall.place(cone, {90, 0, 0}, 0.2);
  auto* part =
      new G4LogicalVolume(new G4Cons("part", 10, 60, 20, 80, 18, 0, 2 * M_PI), nullptr, "part");
  new G4PVDivision("part", part, cone, kZAxis, 5, 0);
  tests::expect_alike(*hall.world);
}

/// Chambers that grow, of two materials in turn, each turned a little more than the one before.
class Chambers : public G4VPVParameterisation {
 public:
  Chambers(G4Material* a, G4Material* b) : materials_{a, b} {}
  void ComputeTransformation(const G4int copy, G4VPhysicalVolume* volume) const override {
    volume->SetTranslation({0, 0, -90.0 + 30 * copy});
    turns_[copy] = G4RotationMatrix();
    turns_[copy].rotateZ(0.1 * copy);
    volume->SetRotation(&turns_[copy]);
  }
  void ComputeDimensions(G4Box& solid, const G4int copy, const G4VPhysicalVolume*) const override {
    solid.SetXHalfLength(20.0 + 5 * copy);
    solid.SetYHalfLength(15.0 + 4 * copy);
    solid.SetZHalfLength(10);
  }
  G4Material* ComputeMaterial(const G4int copy, G4VPhysicalVolume*, const G4VTouchable*) override {
    return materials_[copy % 2];
  }

 private:
  G4Material* materials_[2];
  mutable G4RotationMatrix turns_[7];
};

struct Tracker {
  Hall hall{};
  G4Material* iron = new G4Material("iron", 26, 55.85 * g / mole, 7.87 * g / cm3);
  G4Material* lead = new G4Material("lead", 82, 207.19 * g / mole, 11.35 * g / cm3);
  G4LogicalVolume* chamber = box("chamber", 20, 15, 10, iron);

  Tracker() {
    auto* tracker = box("tracker", 100, 100, 110);
    hall.place(tracker, {5, 0, 0}, 0.3);
    new G4PVPlacement(nullptr, {3, 0, 2}, box("wafer", 8, 9, 1, iron), "wafer", chamber, false, 0);
    new G4PVParameterised("chamber", chamber, tracker, kZAxis, 7, new Chambers(iron, lead));
  }
};

TEST(Parameterised, WithOtherDimensionsAndMaterials) { tests::expect_alike(*Tracker().hall.world); }

TEST(Parameterised, LeavesGeant4InTheCopyThatTheTrackIsIn) {
  const Tracker tracker;
  const auto session = std::make_shared<geant4::Session>(geant4::Options{});
  geant4::Navigator navigator(session);
  navigator.SetWorldVolume(tracker.hall.world);
  const G4ThreeVector along(0, 0, 1);
  G4RotationMatrix turn;
  turn.rotateX(-0.3);  // of the daughter's axes in the hall
  for (const int copy : {4, 1, 6, 3}) {
    const G4ThreeVector point =
        G4ThreeVector(5, 0, 0) + turn * G4ThreeVector(-10, -12, -90.0 + 30 * copy);
    const G4VPhysicalVolume* found =
        navigator.LocateGlobalPointAndSetup(point, &along, copy != 4, false);
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->GetName(), "chamber");
    EXPECT_EQ(found->GetCopyNo(), copy);
    EXPECT_EQ(tracker.chamber->GetMaterial(), copy % 2 == 0 ? tracker.iron : tracker.lead);
    EXPECT_EQ(static_cast<G4Box*>(tracker.chamber->GetSolid())->GetXHalfLength(), 20.0 + 5 * copy);
    const G4TouchableHandle touchable = navigator.CreateTouchableHistoryHandle();
    EXPECT_EQ(touchable->GetReplicaNumber(), copy);
    EXPECT_EQ(touchable->GetReplicaNumber(1), 3);
  }
  // The volumes that differ know Geant4's by their user data.
  const Detector& detector = session->engine(*tracker.hall.world)->geometry.detector();
  std::size_t chambers = 0;
  for (VolumeId id = 0; id < detector.volumes(); ++id) {
    if (detector.volume(id).user_data != reinterpret_cast<std::uintptr_t>(tracker.chamber))
      continue;
    ++chambers;
    EXPECT_NE(detector.material(detector.volume(id)).name, "none");
  }
  EXPECT_EQ(chambers, 7U);
}

TEST(Assemblies, AreImprinted) {
  const Hall hall;
  auto* assembly = new G4AssemblyVolume;
  G4ThreeVector at(0, 0, -20);
  assembly->AddPlacedVolume(box("plate", 30, 30, 4), at, nullptr);
  at = {0, 10, 10};
  auto* turn = new G4RotationMatrix;
  turn->rotateY(0.3);
  assembly->AddPlacedVolume(tube("pipe", 4, 10, 20), at, turn);
  for (int i = 0; i < 4; ++i) {
    G4ThreeVector where(-120.0 + 80 * i, 20.0 * i - 30, 0);
    auto* rotation = new G4RotationMatrix;
    rotation->rotateX(0.5 * i);
    assembly->MakeImprint(hall.volume, where, rotation);
  }
  tests::expect_alike(*hall.world);
}

TEST(Reflections, HaveReflectedDaughters) {
  const Hall hall;
  auto* module = box("module", 50, 40, 30);
  auto* cone = new G4LogicalVolume(new G4Cons("cone", 0, 10, 0, 25, 20, 0, 4), nullptr, "cone");
  new G4PVPlacement(nullptr, {20, 5, 2}, cone, "cone", module, false, 0);
  new G4PVPlacement(nullptr, {-25, 5, 2}, box("chip", 10, 3, 7), "chip", module, false, 1);
  G4ReflectionFactory* factory = G4ReflectionFactory::Instance();
  G4RotationMatrix turn;
  turn.rotateX(0.4);
  factory->Place(G4Transform3D(turn, {-80, 0, 0}), "module", module, hall.volume, false, 0);
  factory->Place(G4Translate3D(80, 0, 0) * G4ReflectX3D(), "module", module, hall.volume, false, 1);
  factory->Place(G4Translate3D(0, 90, 10) * G4Transform3D(turn, {}) * G4ReflectZ3D(), "module",
                 module, hall.volume, false, 2);
  tests::expect_alike(*hall.world);
}

}  // namespace
}  // namespace navjit
