// Binding to a structure: a navigator for all scenes whose parts have the same types. It is
// compiled once, and the numbers are in tables.
#pragma once

#include "codegen/module.hpp"

namespace navjit::codegen {

/// Whether code for the scene's structure would know kinds of solids for which the library's own
/// instance has to ask at run time.
bool gains_from_structure(const Geometry& geometry, const ScenePlan& plan);

/// How many solids the code of a structure handles. The time to compile it grows with this number.
std::size_t solids_of_structure(const Geometry& geometry, const ScenePlan& plan);

/// The navigator of a scene's structure, with this scene's numbers as its data. Scenes of one
/// structure have exactly the same source.
Module generate_structure(const Geometry& geometry, const WorldFacts& facts, const ScenePlan& plan);

}  // namespace navjit::codegen
