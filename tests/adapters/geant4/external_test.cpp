// navjit for single volumes, below Geant4's own navigator.
#include "navjit/geant4/external.hpp"

#include <gtest/gtest.h>
#include <G4Box.hh>
#include <G4GeometryManager.hh>
#include <G4LogicalVolume.hh>
#include <G4Navigator.hh>
#include <G4PVParameterised.hh>
#include <G4PVPlacement.hh>
#include <G4PVReplica.hh>
#include <G4Tubs.hh>
#include <G4VPVParameterisation.hh>
#include <random>

#include "navjit/geant4/geometry.hpp"

namespace navjit {
namespace {

G4LogicalVolume* box(const char* name, double x, double y, double z) {
  return new G4LogicalVolume(new G4Box(name, x, y, z), nullptr, name);
}

/// Two turned modules of bricks and rods. A brick has a chip in it that shares two of its faces.
struct Modules {
  G4LogicalVolume* hall = box("hall", 300, 300, 300);
  G4VPhysicalVolume* world = new G4PVPlacement(nullptr, {}, hall, "hall", nullptr, false, 0);
  G4LogicalVolume* module = box("module", 100, 100, 100);

  Modules() {
    auto *brick = box("brick", 20, 20, 20), *chip = box("chip", 5, 5, 5);
    auto* rod = new G4LogicalVolume(new G4Tubs("rod", 5, 10, 90, 0, 2 * M_PI), nullptr, "rod");
    new G4PVPlacement(nullptr, {15, 15, 0}, chip, "chip", brick, false, 4);
    for (int i = 0; i < 12; ++i) {
      new G4PVPlacement(nullptr, {-80.0 + 40 * (i % 3), -80.0 + 40 * (i / 3), 30}, brick, "brick",
                        module, false, i);
    }
    auto* turn = new G4RotationMatrix;
    turn->rotateX(0.4);
    new G4PVPlacement(turn, {75, 20, -10}, rod, "rod", module, false, 0);
    for (const double x : {-120.0, 120.0}) {
      auto* tilt = new G4RotationMatrix;
      tilt->rotateZ(0.002 * x);
      new G4PVPlacement(tilt, {x, 10, 5}, module, "module", hall, false, x > 0);
    }
  }
};

struct Row {
  std::string volume;
  int copy;
  double length;
  bool has_normal;
  G4ThreeVector normal;
};

/// Straight tracks, some with limits, stepped as Geant4's transportation does.
std::vector<Row> walk(G4Navigator& navigator, int tracks) {
  std::vector<Row> rows;
  std::mt19937_64 random(3);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < tracks; ++i) {
    G4ThreeVector point(uniform(-200, 200), uniform(-200, 200), uniform(-200, 200));
    const G4ThreeVector along =
        G4ThreeVector(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).unit();
    const double limit = i % 2 == 0 ? kInfinity : 15;
    G4VPhysicalVolume* at = navigator.LocateGlobalPointAndSetup(point, nullptr, false);
    for (int n = 0; n < 500 && at != nullptr; ++n) {
      double safety = 0;
      const double found = navigator.ComputeStep(point, along, limit, safety);
      const double length = std::min(found, limit);
      const bool boundary = found <= limit;
      EXPECT_TRUE(!boundary || safety <= length + 1e-9);
      Row row{at->GetName(), at->GetCopyNo(), length, false, {}};
      if (boundary) {
        navigator.SetGeometricallyLimitedStep();
        G4bool valid = false;
        row.normal = navigator.GetGlobalExitNormal(point + length * along, &valid);
        row.has_normal = valid;
      }
      rows.push_back(row);
      point += length * along;
      if (!boundary) {
        navigator.LocateGlobalPointWithinVolume(point);
        EXPECT_GE(navigator.ComputeSafety(point), 0);
        continue;
      }
      at = navigator.LocateGlobalPointAndSetup(point, &along);
    }
  }
  return rows;
}

void expect_equal(const std::vector<Row>& got, const std::vector<Row>& right) {
  ASSERT_EQ(got.size(), right.size());
  for (std::size_t i = 0; i < right.size(); ++i) {
    ASSERT_EQ(got[i].volume, right[i].volume) << i;
    ASSERT_EQ(got[i].copy, right[i].copy) << i;
    ASSERT_NEAR(got[i].length, right[i].length, 1e-6) << i;
    ASSERT_EQ(got[i].has_normal, right[i].has_normal) << i;
    if (right[i].has_normal) {
      ASSERT_LT((got[i].normal - right[i].normal).mag(), 1e-6) << i;
    }
  }
}

TEST(External, NavigatesItsVolumesAsGeant4Does) {
  const Modules modules;
  G4GeometryManager::GetInstance()->CloseGeometry(true, false, modules.world);
  G4Navigator plain;
  plain.SetWorldVolume(modules.world);
  const std::vector<Row> right = walk(plain, 3000);
  EXPECT_GT(right.size(), 15000U);

  G4LogicalVolume* const hot[] = {modules.module};
  auto* external = new geant4::ExternalNavigation(hot);
  EXPECT_EQ(modules.module->CharacteriseDaughters(), kExternal);
  G4Navigator with, another;
  with.SetExternalNavigation(external);
  with.SetWorldVolume(modules.world);
  expect_equal(walk(with, 3000), right);
  another.SetExternalNavigation(external->Clone());
  another.SetWorldVolume(modules.world);
  expect_equal(walk(another, 3000), right);
}

TEST(External, RefusesReplicasAndChangesNothing) {
  const Modules modules;
  auto* stack = box("stack", 50, 50, 50);
  new G4PVReplica("layer", box("layer", 50, 50, 5), stack, kZAxis, 10, 10);
  G4LogicalVolume* const hot[] = {modules.module, stack};
  EXPECT_THROW(geant4::ExternalNavigation{hot}, geant4::Unsupported);
  EXPECT_EQ(modules.module->CharacteriseDaughters(), kNormal);
}

/// Plates that become thicker.
class Plates : public G4VPVParameterisation {
  void ComputeTransformation(const G4int copy, G4VPhysicalVolume* volume) const override {
    volume->SetTranslation({0, 0, -40.0 + 20 * copy});
  }
  void ComputeDimensions(G4Box& solid, const G4int copy, const G4VPhysicalVolume*) const override {
    solid.SetZHalfLength(2.0 + copy);
  }
};

TEST(External, RefusesVolumesWhoseOwnSolidChanges) {
  auto* stack = box("plates", 50, 50, 50);
  auto* plate = box("plate", 50, 50, 5);
  new G4PVPlacement(nullptr, {}, box("cell", 1, 1, 1), "cell", plate, false, 0);
  new G4PVParameterised("plate", plate, stack, kZAxis, 5, new Plates);
  G4LogicalVolume* const hot[] = {plate};
  EXPECT_THROW(geant4::ExternalNavigation{hot}, geant4::Unsupported);
  EXPECT_EQ(plate->CharacteriseDaughters(), kNormal);
}

}  // namespace
}  // namespace navjit
