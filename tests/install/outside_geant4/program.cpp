#include <navjit/geant4/navigator.hpp>
#include <navjit/geant4/use.hpp>

#include <G4Box.hh>
#include <G4GeometryManager.hh>
#include <G4LogicalVolume.hh>
#include <G4PVPlacement.hh>
#include <G4TransportationManager.hh>
#include <cmath>
#include <cstdio>

int main() {
  auto* hall = new G4LogicalVolume(new G4Box("hall", 100, 100, 100), nullptr, "hall");
  auto* world = new G4PVPlacement(nullptr, {}, hall, "hall", nullptr, false, 0);
  auto* brick = new G4LogicalVolume(new G4Box("brick", 10, 20, 30), nullptr, "brick");
  new G4PVPlacement(nullptr, {0, 0, 50}, brick, "brick", hall, false, 7);
  G4GeometryManager::GetInstance()->CloseGeometry(false, false, world);
  const auto session = navjit::geant4::use(*world);
  G4Navigator* navigator =
      G4TransportationManager::GetTransportationManager()->GetNavigatorForTracking();
  navigator->SetWorldVolume(world);
  const G4ThreeVector start(0, 0, -50), along(0, 0, 1);
  navigator->LocateGlobalPointAndSetup(start, &along, false, false);
  G4double safety = 0;
  const G4double length = navigator->ComputeStep(start, along, 1000, safety);
  const bool ours = dynamic_cast<navjit::geant4::Navigator*>(navigator) != nullptr;
  std::printf("%g mm by %s\n", length, ours ? "navjit" : "Geant4");
  return ours && std::abs(length - 70) < 1e-9 ? 0 : 1;
}
