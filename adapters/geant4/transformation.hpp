// Where a volume is placed.
#pragma once

#include <G4RotationMatrix.hh>
#include <G4VPhysicalVolume.hh>

#include "navjit/transformation.hpp"

namespace navjit::geant4 {

/// From what a physical volume says at this moment.
inline Transformation transformation(const G4VPhysicalVolume& volume) {
  const G4ThreeVector origin = volume.GetTranslation();
  const G4RotationMatrix* r = volume.GetRotation();
  if (r == nullptr) return placed_at({origin.x(), origin.y(), origin.z()});
  return make_transformation(
      {origin.x(), origin.y(), origin.z()},
      {r->xx(), r->xy(), r->xz(), r->yx(), r->yy(), r->yz(), r->zx(), r->zy(), r->zz()});
}

}  // namespace navjit::geant4
