// Electrons, positrons and photons, with models that need none of Geant4's data files.
#pragma once

#include <G4VUserPhysicsList.hh>

/// Moller and Bhabha scattering, bremsstrahlung, multiple scattering, annihilation, photoelectric
/// effect, Compton scattering, pairs. Good enough to see what navigation costs; not for results.
class Physics : public G4VUserPhysicsList {
 public:
  /// Production cuts, mm.
  explicit Physics(double cut);
  void ConstructParticle() override;
  void ConstructProcess() override;
};

/// Geant4 wants a table of excited nuclei, which this physics does not use: names an empty one.
void name_empty_data();
