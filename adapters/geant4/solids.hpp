// Converts Geant4's solids to navjit's.
#pragma once

#include <G4AffineTransform.hh>
#include <G4VSolid.hh>
#include <string>
#include <vector>

#include "navjit/solids.hpp"

namespace navjit::geant4 {

/// Solids that Geant4 itself answers for, since navjit has no kernel for them.
using ForeignSolids = std::vector<const G4VSolid*>;

/// The same solid, in mm and rad. Solids are recognised by their exact class: a class that a user
/// derived from one of Geant4's may answer otherwise. If navjit has no kernel for a solid, or its
/// makers refuse the dimensions, Geant4 goes on to answer for it, and it is added to `foreign`.
/// Throws Unsupported if such a solid does not tell its size.
Solid convert(const G4VSolid& solid, ForeignSolids& foreign);

/// The same for solids of several parts: booleans, displaced, reflected, scaled; empty for others.
/// Throws GeometryError if the dimensions make no solid.
Solid convert_composite(const G4VSolid& solid, ForeignSolids& foreign);
/// The same for solids that are given by polygons, planes or facets; empty for others.
Solid convert_contour(const G4VSolid& solid);
/// The solid as a foreign solid of navjit.
Solid convert_foreign(const G4VSolid& solid);

/// Everything that matters of a solid, as text, since a parameterisation changes it in place.
std::string text_of(const G4VSolid& solid);

}  // namespace navjit::geant4
