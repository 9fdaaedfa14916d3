// Copies that depend on their mothers' copies, and phantoms of voxels.
#include <gtest/gtest.h>
#include <G4Box.hh>
#include <G4LogicalVolume.hh>
#include <G4Material.hh>
#include <G4PVParameterised.hh>
#include <G4PVPlacement.hh>
#include <G4PVReplica.hh>
#include <G4PhantomParameterisation.hh>
#include <G4SystemOfUnits.hh>
#include <G4TouchableHistory.hh>
#include <G4VNestedParameterisation.hh>

#include "navjit/geant4/navigator.hpp"
#include "tests/adapters/geant4/walk.hpp"

namespace navjit {
namespace {

G4LogicalVolume* box(const char* name, double x, double y, double z,
                     G4Material* material = nullptr) {
  return new G4LogicalVolume(new G4Box(name, x, y, z), material, name);
}

struct Hall {
  G4LogicalVolume* volume = box("hall", 200, 200, 200);
  G4VPhysicalVolume* world = new G4PVPlacement(nullptr, {}, volume, "hall", nullptr, false, 0);
  G4LogicalVolume* container = box("container", 80, 60, 50);

  Hall() {
    auto* turn = new G4RotationMatrix;
    turn->rotateX(0.3);
    new G4PVPlacement(turn, {5, -10, 20}, container, "container", volume, false, 0);
  }
};

/// Voxels along z of two materials, a chess board together with the columns and rows around them.
class Board : public G4VNestedParameterisation {
 public:
  Board(G4Material* a, G4Material* b) : materials_{a, b} {}
  G4Material* ComputeMaterial(G4VPhysicalVolume*, const G4int copy,
                              const G4VTouchable* mother) override {
    if (mother == nullptr) return materials_[0];
    return materials_[(copy + mother->GetReplicaNumber(0) + mother->GetReplicaNumber(1)) % 2];
  }
  G4int GetNumberOfMaterials() const override { return 2; }
  G4Material* GetMaterial(G4int index) const override { return materials_[index]; }
  void ComputeTransformation(const G4int copy, G4VPhysicalVolume* volume) const override {
    volume->SetTranslation({0, 0, -40.0 + 20 * copy});
  }
  void ComputeDimensions(G4Box& solid, const G4int, const G4VPhysicalVolume*) const override {
    solid.SetXHalfLength(10);
    solid.SetYHalfLength(15);
    solid.SetZHalfLength(10);
  }

 private:
  G4Material* materials_[2];
};

struct Chess {
  Hall hall{};
  G4Material* iron = new G4Material("iron", 26, 55.85 * g / mole, 7.87 * g / cm3);
  G4Material* lead = new G4Material("lead", 82, 207.19 * g / mole, 11.35 * g / cm3);
  G4LogicalVolume* voxel = box("voxel", 10, 15, 10, iron);

  Chess() {
    auto* row = box("row", 80, 15, 50);
    new G4PVReplica("row", row, hall.container, kYAxis, 4, 30);
    auto* column = box("column", 10, 15, 50);
    new G4PVReplica("column", column, row, kXAxis, 8, 20);
    new G4PVParameterised("voxel", voxel, column, kZAxis, 5, new Board(iron, lead));
  }
};

TEST(Nested, AreWalkedAlike) { tests::expect_alike(*Chess().hall.world); }

TEST(Nested, HaveTheMaterialOfTheMothersCopy) {
  const Chess chess;
  const auto session = std::make_shared<geant4::Session>(geant4::Options{});
  geant4::Navigator navigator(session);
  navigator.SetWorldVolume(chess.hall.world);
  G4RotationMatrix turn;
  turn.rotateX(-0.3);
  const G4ThreeVector along(0, 0, 1);
  int seen[2] = {0, 0};
  for (int i = 0; i < 160; ++i) {
    const int row = i % 4, column = (i / 4) % 8, copy = i / 32;
    const G4ThreeVector point =
        G4ThreeVector(5, -10, 20) +
        turn * G4ThreeVector(-70.0 + 20 * column, -45.0 + 30 * row, -40.0 + 20 * copy);
    const G4VPhysicalVolume* found =
        navigator.LocateGlobalPointAndSetup(point, &along, i % 2 == 0, false);
    ASSERT_NE(found, nullptr);
    ASSERT_EQ(found->GetName(), "voxel");
    const G4TouchableHandle touchable = navigator.CreateTouchableHistoryHandle();
    ASSERT_EQ(touchable->GetReplicaNumber(0), copy);
    ASSERT_EQ(touchable->GetReplicaNumber(1), column);
    ASSERT_EQ(touchable->GetReplicaNumber(2), row);
    const int which = (copy + column + row) % 2;
    ASSERT_EQ(chess.voxel->GetMaterial(), which == 0 ? chess.iron : chess.lead);
    ++seen[which];
  }
  EXPECT_EQ(seen[0], seen[1]);
}

/// Voxels of 10 mm, of three materials, which fill the container.
G4PVParameterised* phantom(const Hall& hall, bool skip) {
  static std::vector<std::size_t> indices;
  constexpr int nx = 16, ny = 12, nz = 10;
  indices.clear();
  for (std::size_t i = 0; i < nx * ny * nz; ++i) indices.push_back((i / 3) % 3);
  std::vector<G4Material*> materials;
  for (int z = 6; z < 9; ++z) {
    materials.push_back(new G4Material("m" + std::to_string(z), z, 2 * z * g / mole, g / cm3));
  }
  auto* parameterisation = new G4PhantomParameterisation;
  parameterisation->SetVoxelDimensions(5, 5, 5);
  parameterisation->SetNoVoxels(nx, ny, nz);
  parameterisation->SetMaterials(materials);
  parameterisation->SetMaterialIndices(indices.data());
  parameterisation->BuildContainerSolid(hall.container->GetSolid());
  parameterisation->SetSkipEqualMaterials(skip);
  auto* volume = new G4PVParameterised("phantom", box("voxel", 5, 5, 5), hall.container, kXAxis,
                                       nx * ny * nz, parameterisation);
  volume->SetRegularStructureId(1);
  return volume;
}

TEST(Phantoms, AreWalkedAlikeWhereEveryBoundaryCounts) {
  const Hall hall;
  phantom(hall, false);
  tests::expect_alike(*hall.world);
}

TEST(Phantoms, AreRefusedWhereBoundariesAreSkipped) {
  const Hall hall;
  phantom(hall, true);
  try {
    const geant4::Geometry geometry(*hall.world);
    FAIL() << "it was converted";
  } catch (const geant4::Unsupported& error) {
    EXPECT_NE(std::string(error.what()).find("'phantom'"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("SetSkipEqualMaterials"), std::string::npos);
  }
}

TEST(Phantoms, AreRefusedWhereTheyAreTooMany) {
  const Hall hall;
  new G4PVParameterised("many", box("voxel", 10, 15, 10), hall.container, kZAxis, 2000000,
                        new Board(nullptr, nullptr));
  try {
    const geant4::Geometry geometry(*hall.world);
    FAIL() << "it was converted";
  } catch (const geant4::Unsupported& error) {
    EXPECT_NE(std::string(error.what()).find("'many'"), std::string::npos) << error.what();
  }
}

TEST(Refusal, LeavesGeant4sNavigator) {
  const Hall hall;
  phantom(hall, true);
  const tests::Walked walked = tests::walk(*hall.world, {.tracks = 10});
  EXPECT_NE(walked.refusal.find("volume 'phantom'"), std::string::npos) << walked.refusal;
  EXPECT_EQ(walked.counts.differences.steps, 0U);
  EXPECT_GT(walked.boundaries, 10U);  // Geant4's own navigator did it
}

}  // namespace
}  // namespace navjit
