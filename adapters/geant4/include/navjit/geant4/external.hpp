// navjit for single volumes of an application that keeps its own navigator.
#pragma once

#include <G4LogicalVolume.hh>
#include <G4VExternalNavigation.hh>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "navjit/navigator.hpp"
#include "navjit/options.hpp"

namespace navjit::geant4 {

/// A volume that navjit navigates: what it and its daughters are to it.
struct ExternalVolume;

/// Navigation in these volumes, among their daughters; all else is Geant4's as before. For volumes
/// that take much of the time, with many placed daughters, say. One for each navigator, which owns
/// it; the others get a Clone():
///
///   auto* external = new navjit::geant4::ExternalNavigation(hot);   // after the geometry is made
///   navigator->SetExternalNavigation(external);
class ExternalNavigation : public G4VExternalNavigation {
 public:
  /// Converts the volumes and changes the type of their daughters to kExternal: from then on each
  /// navigator of the process needs one of these. They have to stay as they are. Throws Unsupported
  /// if a volume has replicas or a parameterisation, GeometryError if a solid is none; then
  /// nothing is changed.
  explicit ExternalNavigation(std::span<G4LogicalVolume* const> volumes,
                              const RuntimeOptions& options = {});
  ~ExternalNavigation() override;
  ExternalNavigation& operator=(const ExternalNavigation&) = delete;

  /// For another navigator, of this thread or another; the volumes are shared.
  G4VExternalNavigation* Clone() override;

  G4bool LevelLocate(G4NavigationHistory& history, const G4VPhysicalVolume* blocked,
                     G4int blocked_number, const G4ThreeVector& point,
                     const G4ThreeVector* direction, G4bool on_edge,
                     G4ThreeVector& local_point) override;
  G4double ComputeStep(const G4ThreeVector& local_point, const G4ThreeVector& local_direction,
                       G4double limit, G4double& safety, G4NavigationHistory& history,
                       G4bool& valid_normal, G4ThreeVector& normal, G4bool& exiting,
                       G4bool& entering, G4VPhysicalVolume** entered,
                       G4int& entered_number) override;
  G4double ComputeSafety(const G4ThreeVector& local_point, const G4NavigationHistory& history,
                         G4double enough) override;

 private:
  using Volumes = std::unordered_map<const G4LogicalVolume*, std::shared_ptr<ExternalVolume>>;
  /// A volume with this object's own navigator.
  struct Own {
    ExternalVolume* volume;
    navjit::Navigator navigator;
  };

  ExternalNavigation(const ExternalNavigation& other);
  Own& own(const G4NavigationHistory& history);

  std::shared_ptr<const Volumes> volumes_;
  std::unordered_map<const G4LogicalVolume*, Own> own_;
};

}  // namespace navjit::geant4
