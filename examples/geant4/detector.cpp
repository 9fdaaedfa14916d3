#include "detector.hpp"

#include <G4Box.hh>
#include <G4Element.hh>
#include <G4GDMLParser.hh>
#include <G4GlobalMagFieldMessenger.hh>
#include <G4LogicalVolume.hh>
#include <G4Material.hh>
#include <G4PVPlacement.hh>
#include <G4PVReplica.hh>
#include <G4SystemOfUnits.hh>

namespace {

G4LogicalVolume* box(const char* name, double width, double thickness, G4Material* material) {
  return new G4LogicalVolume(new G4Box(name, width / 2, width / 2, thickness / 2), material, name);
}

G4VPhysicalVolume* calorimeter() {
  auto* lead = new G4Material("Lead", 82, 207.2 * g / mole, 11.35 * g / cm3);
  auto* argon = new G4Material("LiquidArgon", 18, 39.95 * g / mole, 1.39 * g / cm3);
  auto* vacuum = new G4Material("Vacuum", 1, 1.008 * g / mole, 1e-25 * g / cm3, kStateGas);
  constexpr int layers = 50;
  const double absorber = 2.3 * mm, gap = 5.7 * mm, width = 400 * mm;
  const double layer = absorber + gap;
  auto* hall = box("Hall", 2 * width, 2 * layers * layer, vacuum);
  auto* stack = box("Calorimeter", width, layers * layer, vacuum);
  new G4PVPlacement(nullptr, {}, stack, "Calorimeter", hall, false, 0);
  auto* one = box("Layer", width, layer, vacuum);
  new G4PVReplica("Layer", one, stack, kZAxis, layers, layer);
  new G4PVPlacement(nullptr, {0, 0, -gap / 2}, box("Absorber", width, absorber, lead), "Absorber",
                    one, false, 0);
  new G4PVPlacement(nullptr, {0, 0, absorber / 2}, box("Gap", width, gap, argon), "Gap", one, false,
                    1);
  return new G4PVPlacement(nullptr, {}, hall, "Hall", nullptr, false, 0);
}

}  // namespace

G4VPhysicalVolume* Detector::Construct() {
  if (file_.empty()) return calorimeter();
  G4GDMLParser parser;
  parser.Read(file_, false);
  return parser.GetWorldVolume();
}

void Detector::ConstructSDandField() {
  if (field_ == 0) return;
  static G4ThreadLocal G4GlobalMagFieldMessenger* messenger = nullptr;
  messenger = new G4GlobalMagFieldMessenger({0, field_ * tesla, 0});
  messenger->SetVerboseLevel(0);
}
