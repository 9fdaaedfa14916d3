// The copies of replicas, divisions and parameterised volumes.
#pragma once

#include <G4Material.hh>
#include <G4VPhysicalVolume.hh>
#include <G4VSolid.hh>
#include <functional>

#include "navjit/solids.hpp"

namespace navjit::geant4 {

/// One copy. The physical volume's own transformation is the copy's.
struct Copy {
  G4int number;
  const G4VSolid* solid;       ///< of its logical volume, in the copy's dimensions
  const G4Material* material;  ///< may be null
  bool changing = true;        ///< whether copies may have other solids
  /// Instead of `solid`, where Geant4 ignores that: rings along the radius.
  Solid shape{};
};

/// Calls `take` with each copy, in order. Throws Unsupported where the copies depend on more than
/// their number, or Geant4 does not stop at their boundaries.
void for_each_copy(G4VPhysicalVolume& volume, const std::function<void(const Copy&)>& take);

}  // namespace navjit::geant4
