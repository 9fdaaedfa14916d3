// What volumes are made of.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "navjit/detail/api.hpp"

namespace NAVJIT_API navjit {

/// State of matter, as the file gives it.
enum class MaterialState : std::uint8_t { undefined, solid, liquid, gas };

/// A nuclide.
struct Isotope {
  std::string name;
  double z = 0;         ///< charge of the nucleus, elementary charges; 0 where the file gives none
  double nucleons = 0;  ///< 0 where the file gives none
  double a = 0;         ///< molar mass, g/mol; 0 where the file gives none
};

/// An isotope in an element.
struct IsotopeShare {
  std::uint32_t isotope;  ///< a number below Detector::isotopes()
  double abundance;       ///< by number of atoms, as the file gives it
};

/// A chemical element, or what a file calls one.
struct Element {
  std::string name;
  std::string formula{};  ///< often the chemical symbol; empty where the file gives none
  double z = 0;  ///< charge of the nucleus, elementary charges; 0 where the file gives none
  double a = 0;  ///< molar mass, g/mol, the mean of the isotopes if these are given; 0 if unknown
  std::vector<IsotopeShare> isotopes{};  ///< empty where the file gives none
};

/// An element in a material.
struct ElementShare {
  std::uint32_t element;  ///< a number below Detector::elements()
  double fraction;        ///< share of the mass; those of a material add up to one
};

/// What volumes are filled with.
struct Material {
  std::string name;
  double density = 0;  ///< g/cm3; 0 where the file gives none
  MaterialState state = MaterialState::undefined;
  double temperature = 293.15;  ///< K
  double pressure = 101325;     ///< Pa
  double radiation_length = 0;  ///< mm; 0 where density or composition are not known
  /// The elements that it is made of; mixtures are resolved, and atoms are counted as mass. A
  /// material that is given by Z has one element of its own name. Empty if some of it is not known.
  std::vector<ElementShare> elements{};
};

/// What radiation_length() needs to know of a nuclide or element within a material.
struct MaterialComponent {
  double z;         ///< charge of the nucleus, elementary charges
  double a;         ///< molar mass, g/mol
  double fraction;  ///< share of the mass

  friend bool operator==(const MaterialComponent&, const MaterialComponent&) = default;
};

/// Radiation length of one element, g/cm2: Y.-S. Tsai, Rev. Mod. Phys. 46 (1974) 815, as the Review
/// of Particle Physics gives it (section "Passage of particles through matter"), with its fit of
/// the Coulomb correction. 0 unless z >= 0.5 and a > 0 (g/mol). Both functions are thread-safe.
double radiation_length(double z, double a);
/// The radiation length of a mixture or compound, g/cm2: inverse lengths are added by mass. The
/// fractions need not add up to one. 0 if there are no components, or if one of them has none.
double radiation_length(std::span<const MaterialComponent> components);

}  // namespace navjit
