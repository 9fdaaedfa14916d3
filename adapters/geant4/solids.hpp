// Geant4's solids as navjit's.
#pragma once

#include <G4AffineTransform.hh>
#include <G4VSolid.hh>
#include <string>
#include <vector>

#include "navjit/solids.hpp"

namespace navjit::geant4 {

/// Solids that Geant4 itself answers for: navjit has no kernel for them.
using ForeignSolids = std::vector<const G4VSolid*>;

/// The same solid, mm and rad. Solids are recognised by their very class: one that a user derived
/// from a class of Geant4's may answer otherwise. What navjit has no kernel for, or whose
/// dimensions its makers refuse, goes on to be asked itself, and is added to `foreign`. Throws
/// Unsupported if that says nothing of its size.
Solid convert(const G4VSolid& solid, ForeignSolids& foreign);

/// The same for solids of several parts: booleans, displaced, reflected, scaled; empty for others.
/// Throws GeometryError if its dimensions make no solid.
Solid convert_composite(const G4VSolid& solid, ForeignSolids& foreign);
/// The same for those that polygons, planes or facets are given for; empty for others.
Solid convert_contour(const G4VSolid& solid);
/// The solid behind navjit's functions for foreign ones.
Solid convert_foreign(const G4VSolid& solid);

/// All of a solid that matters, as text: a parameterisation changes it in place.
std::string text_of(const G4VSolid& solid);

}  // namespace navjit::geant4
