// Materials by name, for files that have none.
#pragma once

#include <string>
#include <vector>

#include "navjit/builder.hpp"

namespace navjit::apps {

/// What a user says of a material.
struct MaterialWish {
  std::string name;
  double density = 0;     ///< g/cm3; 0: that of the name
  std::string formula{};  ///< "Al2O3"; empty: that of the name
};

/// Names that stand for a density and a composition.
std::vector<std::string> known_materials();

/// Adds the material to a builder: a known one, one with density and formula, or one of Geant4's
/// (G4_...), which is left to whoever reads the file. Throws UsageError for any other, or a formula
/// that is none.
DetectorBuilder::MaterialId add_material(DetectorBuilder& builder, const MaterialWish& wish);

}  // namespace navjit::apps
