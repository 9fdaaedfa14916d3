// Lists the copies of replicas, divisions and parameterised volumes.
#pragma once

#include <G4Material.hh>
#include <G4VPhysicalVolume.hh>
#include <G4VSolid.hh>
#include <functional>

#include "navjit/solids.hpp"

namespace navjit::geant4 {

/// One copy. Meanwhile the physical volume's own transformation is that of the copy.
struct Copy {
  G4int number;
  const G4VSolid* solid;       ///< that of its logical volume, with the copy's dimensions
  const G4Material* material;  ///< may be null
  bool changing = true;        ///< whether other copies may have other solids
  /// Takes the place of `solid` where Geant4 ignores that: rings along the radius.
  Solid shape{};
};

/// Calls `take` with each copy, in order. Throws Unsupported if the copies depend on more than
/// their number, or if Geant4 does not stop at their boundaries.
void for_each_copy(G4VPhysicalVolume& volume, const std::function<void(const Copy&)>& take);

}  // namespace navjit::geant4
