// Units of GDML by name, in the system of Geant4: mm, ns, MeV, positron charge, kelvin, rad.
#pragma once

#include <optional>
#include <string_view>

namespace navjit::gdml {

enum class Dimension { length, angle, density, molar_mass, temperature, pressure, other };

struct Unit {
  std::string_view name;
  double value;  ///< densities in g/cm3, all else in Geant4's system
  Dimension dimension;
};

/// The unit that has this name or symbol in a `unit` attribute, if it is known.
std::optional<Unit> find_unit(std::string_view name);
/// The value of a name that expressions know without a definition: units, pi, twopi, halfpi, ...
/// These are fewer units than attributes have, as in Geant4.
std::optional<double> find_builtin(std::string_view name);

}  // namespace navjit::gdml
