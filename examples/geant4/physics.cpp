#include "physics.hpp"

#include <G4BetheHeitlerModel.hh>
#include <G4ChargedGeantino.hh>
#include <G4ComptonScattering.hh>
#include <G4Electron.hh>
#include <G4EmParameters.hh>
#include <G4Gamma.hh>
#include <G4GammaConversion.hh>
#include <G4Geantino.hh>
#include <G4KleinNishinaCompton.hh>
#include <G4PEEffectFluoModel.hh>
#include <G4PhotoElectricEffect.hh>
#include <G4PhysicsListHelper.hh>
#include <G4Positron.hh>
#include <G4Proton.hh>
#include <G4SystemOfUnits.hh>
#include <G4UrbanMscModel.hh>
#include <G4eBremsstrahlung.hh>
#include <G4eBremsstrahlungRelModel.hh>
#include <G4eIonisation.hh>
#include <G4eMultipleScattering.hh>
#include <G4eeToTwoGammaModel.hh>
#include <G4eplusAnnihilation.hh>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace {

void add_lepton(G4ParticleDefinition* particle) {
  auto* helper = G4PhysicsListHelper::GetPhysicsListHelper();
  auto* scattering = new G4eMultipleScattering;
  scattering->SetEmModel(new G4UrbanMscModel);
  helper->RegisterProcess(scattering, particle);
  helper->RegisterProcess(new G4eIonisation, particle);
  auto* bremsstrahlung = new G4eBremsstrahlung;
  for (int i = 0; i < 2; ++i) {  // below 1 GeV, where the default has data files, and above
    auto* model = new G4eBremsstrahlungRelModel;
    model->SetLowEnergyLimit(1 * keV);
    bremsstrahlung->SetEmModel(model);
  }
  helper->RegisterProcess(bremsstrahlung, particle);
}

}  // namespace

Physics::Physics(double cut) {
  SetVerboseLevel(0);
  SetDefaultCutValue(cut * mm);
  G4EmParameters::Instance()->SetVerbose(0);
}

void Physics::ConstructParticle() {
  G4Gamma::Definition();
  G4Electron::Definition();
  G4Positron::Definition();
  G4Proton::Definition();  // has a production cut
  G4Geantino::Definition();
  G4ChargedGeantino::Definition();
}

void Physics::ConstructProcess() {
  AddTransportation();
  add_lepton(G4Electron::Definition());
  add_lepton(G4Positron::Definition());
  auto* helper = G4PhysicsListHelper::GetPhysicsListHelper();
  auto* annihilation = new G4eplusAnnihilation;
  annihilation->SetEmModel(new G4eeToTwoGammaModel);
  helper->RegisterProcess(annihilation, G4Positron::Definition());
  G4ParticleDefinition* gamma = G4Gamma::Definition();
  auto* photoelectric = new G4PhotoElectricEffect;
  photoelectric->SetEmModel(new G4PEEffectFluoModel);
  helper->RegisterProcess(photoelectric, gamma);
  auto* compton = new G4ComptonScattering;
  compton->SetEmModel(new G4KleinNishinaCompton);
  helper->RegisterProcess(compton, gamma);
  auto* pairs = new G4GammaConversion;
  pairs->SetEmModel(new G4BetheHeitlerModel);
  helper->RegisterProcess(pairs, gamma);
}

void name_empty_data() {
  const auto folder = std::filesystem::temp_directory_path() / "geant4_without_data";
  std::filesystem::create_directories(folder);
  const std::ofstream empty(folder / "ENSDFSTATE.dat", std::ios::app);
  setenv("G4ENSDFSTATEDATA", folder.c_str(), 0);
}
