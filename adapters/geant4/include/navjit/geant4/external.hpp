// navjit for single volumes of an application that otherwise keeps its own navigator.
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

/// A volume that navjit navigates, as navjit sees it and its daughters.
struct ExternalVolume;

/// Navigates in these volumes, among their daughters; everything else is Geant4's as before. It
/// serves volumes that take much of the time, such as those with many placed daughters. Each
/// navigator owns one of these objects; further navigators get a Clone():
///
///   auto* external = new navjit::geant4::ExternalNavigation(hot);   // after the geometry is made
///   navigator->SetExternalNavigation(external);
class ExternalNavigation : public G4VExternalNavigation {
 public:
  /// Converts the volumes and changes the type of their daughters to kExternal: from then on each
  /// navigator of the process needs one of these objects, and the volumes must not change. Throws
  /// Unsupported if a volume has replicas or a parameterisation, GeometryError if the dimensions of
  /// a solid make none; then nothing is changed.
  explicit ExternalNavigation(std::span<G4LogicalVolume* const> volumes,
                              const RuntimeOptions& options = {});
  ~ExternalNavigation() override;
  ExternalNavigation& operator=(const ExternalNavigation&) = delete;

  /// Makes one for another navigator, of this thread or another; the volumes are shared.
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
  /// One of the volumes, with this object's own navigator in it.
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
