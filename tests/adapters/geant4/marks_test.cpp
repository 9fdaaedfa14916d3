// Volumes that Geant4's run observes become tags of the converted detector.
#include <gtest/gtest.h>
#include <G4Box.hh>
#include <G4HCofThisEvent.hh>
#include <G4LogicalVolume.hh>
#include <G4Material.hh>
#include <G4PVPlacement.hh>
#include <G4Region.hh>
#include <G4SystemOfUnits.hh>
#include <G4VSensitiveDetector.hh>

#include "navjit/geant4/geometry.hpp"
#include "navjit/observation.hpp"

namespace navjit {
namespace {

class Sensitive : public G4VSensitiveDetector {
 public:
  using G4VSensitiveDetector::G4VSensitiveDetector;
  G4bool ProcessHits(G4Step*, G4TouchableHistory*) override { return true; }
};

VolumeId find(const Detector& detector, const std::string& name) {
  for (VolumeId v = 0; v < detector.volumes(); ++v) {
    if (detector.volume(v).name == name) return v;
  }
  ADD_FAILURE() << "no volume " << name;
  return 0;
}

TEST(Marks, OfSensitiveDetectorsAndRegions) {
  auto* air = new G4Material("air", 7, 14 * g / mole, 1.2 * mg / cm3);
  const auto box = [&](const char* name, double half) {
    return new G4LogicalVolume(new G4Box(name, half, half, half), air, name);
  };
  auto* hall = box("hall", 100);
  auto* world = new G4PVPlacement(nullptr, {}, hall, "hall", nullptr, false, 0);
  auto *envelope = box("envelope", 40), *inner = box("inner", 10), *cell = box("cell", 10),
       *tracker = box("tracker", 15), *layer = box("layer", 5);
  new G4PVPlacement(nullptr, {50, 0, 0}, envelope, "envelope", hall, false, 0);
  new G4PVPlacement(nullptr, {-50, 0, 0}, tracker, "tracker", hall, false, 0);
  new G4PVPlacement(nullptr, {15, 0, 0}, inner, "inner", envelope, false, 0);
  new G4PVPlacement(nullptr, {-15, 0, 0}, cell, "cell", envelope, false, 0);
  new G4PVPlacement(nullptr, {}, layer, "layer", tracker, false, 0);
  cell->SetSensitiveDetector(new Sensitive("cells"));
  auto* region = new G4Region("Tracker");
  region->AddRootLogicalVolume(tracker);

  const geant4::Geometry geometry(*world);
  const Detector& detector = geometry.detector();
  const Auxiliary* tag =
      find_auxiliary(detector.volume(find(detector, "cell")).auxiliaries, "SensDet");
  ASSERT_NE(tag, nullptr);
  EXPECT_EQ(tag->value, "cells");
  tag = find_auxiliary(detector.volume(find(detector, "tracker")).auxiliaries, "Region");
  ASSERT_NE(tag, nullptr);
  EXPECT_EQ(tag->value, "Tracker");

  // All are of air: what counts is the cells' and the tracker's boundaries.
  const ObservedDetector seen(detector, {.kind = Observation::Kind::materials});
  const auto counts = [&](const char* from, const char* to) {
    return seen.counts(find(detector, from), find(detector, to));
  };
  EXPECT_TRUE(counts("envelope", "cell"));
  EXPECT_TRUE(counts("hall", "tracker"));
  EXPECT_FALSE(counts("tracker", "layer"));
  EXPECT_FALSE(counts("hall", "envelope"));
  EXPECT_FALSE(counts("envelope", "inner"));
}

}  // namespace
}  // namespace navjit
