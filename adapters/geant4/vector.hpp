// Converts Geant4's vectors to navjit's, and back.
#pragma once

#include <G4ThreeVector.hh>

#include "navjit/vector.hpp"

namespace navjit::geant4 {

inline Vec3 vector(const G4ThreeVector& v) { return {v.x(), v.y(), v.z()}; }
inline G4ThreeVector vector(const Vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace navjit::geant4
