// Geant4's solids as navjit's.
#pragma once

#include <G4AffineTransform.hh>
#include <G4VSolid.hh>

#include "navjit/solids.hpp"

namespace navjit::geant4 {

/// The same solid, mm and rad. Solids are recognised by their very class: one that a user derived
/// from a class of Geant4's may answer otherwise. Throws Unsupported if there is no such kernel,
/// GeometryError if its dimensions make no solid.
Solid convert(const G4VSolid& solid);

/// The same for solids of several parts: booleans, displaced, reflected, scaled; empty for others.
Solid convert_composite(const G4VSolid& solid);
/// The same for those that polygons, planes or facets are given for; empty for others.
Solid convert_contour(const G4VSolid& solid);

}  // namespace navjit::geant4
