#include "adapters/geant4/materials.hpp"

#include <G4Element.hh>
#include <G4SystemOfUnits.hh>

namespace navjit::geant4 {
namespace {

MaterialState state_of(G4State state) {
  switch (state) {
    case kStateSolid:
      return MaterialState::solid;
    case kStateLiquid:
      return MaterialState::liquid;
    case kStateGas:
      return MaterialState::gas;
    default:
      return MaterialState::undefined;
  }
}

}  // namespace

DetectorBuilder::MaterialId Materials::operator()(const G4Material* material) {
  const auto [entry, added] = materials_.try_emplace(material);
  if (!added) return entry->second;
  if (material == nullptr) return entry->second = builder_.material({.name = "none"});
  Material made{.name = material->GetName(),
                .density = material->GetDensity() / (g / cm3),
                .state = state_of(material->GetState()),
                .temperature = material->GetTemperature() / kelvin,
                .pressure = material->GetPressure() / hep_pascal,
                .radiation_length = material->GetRadlen() / mm};
  for (std::size_t i = 0; i < material->GetNumberOfElements(); ++i) {
    const G4Element* element = material->GetElement(static_cast<G4int>(i));
    const auto [known, is_new] = elements_.try_emplace(element);
    if (is_new) {
      known->second = builder_.element({.name = element->GetName(),
                                        .formula = element->GetSymbol(),
                                        .z = element->GetZ(),
                                        .a = element->GetA() / (g / mole)});
    }
    made.elements.push_back({known->second, material->GetFractionVector()[i]});
  }
  return entry->second = builder_.material(std::move(made));
}

}  // namespace navjit::geant4
