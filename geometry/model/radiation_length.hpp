// Radiation lengths from what a material is made of.
#pragma once

#include <span>

namespace navjit {

/// A nuclide or element within a material.
struct MaterialComponent {
  double z;         ///< charge of the nucleus, elementary charges
  double a;         ///< molar mass, g/mol
  double fraction;  ///< of the mass

  friend bool operator==(const MaterialComponent&, const MaterialComponent&) = default;
};

/// Radiation length of one element, g/cm2: Y.-S. Tsai, Rev. Mod. Phys. 46 (1974) 815, as the Review
/// of Particle Physics gives it (section "Passage of particles through matter"), with its fit of
/// the Coulomb correction. 0 unless z >= 0.5 and a > 0.
double radiation_length(double z, double a);
/// That of a mixture or compound, g/cm2: inverse lengths add by mass. Fractions need not add up to
/// one. 0 if there are no components, or one of them has none.
double radiation_length(std::span<const MaterialComponent> components);

}  // namespace navjit
