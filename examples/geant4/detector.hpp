// The detector: from a GDML file, or a calorimeter made in code.
#pragma once

#include <G4VUserDetectorConstruction.hh>
#include <string>

/// A GDML file's world; with an empty name, a calorimeter of 50 layers of lead and liquid argon, as
/// replicas. A uniform magnetic field along y, tesla, unless 0.
class Detector : public G4VUserDetectorConstruction {
 public:
  Detector(std::string file, double field) : file_(std::move(file)), field_(field) {}
  G4VPhysicalVolume* Construct() override;
  void ConstructSDandField() override;

 private:
  std::string file_;
  double field_;
};
