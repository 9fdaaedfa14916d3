// What particles go through: by volume, for each mm of way.
#pragma once

#include <vector>

#include "geometry/model/world.hpp"

namespace navjit::common {

/// For each mm; 0 where the material does not tell.
struct MaterialRates {
  double radiation_lengths = 0;
  double mass = 0;                 ///< g/cm2
  double interaction_lengths = 0;  ///< nuclear ones
};

/// Of a material of the world.
MaterialRates rates_of(const World& world, const Material& material);

/// By number of the volume.
std::vector<MaterialRates> material_rates(const World& world);

/// Nuclear interaction length of a mixture, g/cm2: 35 g/cm2 times the third root of the molar mass
/// for each element, inverse lengths added by mass. It is the estimate that Geant4 prints for
/// materials; the measured lengths of the Review of Particle Physics differ by some 7 % from carbon
/// to lead, and by a third for hydrogen. 0 if the composition is not known.
double interaction_length(const World& world, const Material& material);

}  // namespace navjit::common
