// Binding to a structure: a navigator for all scenes whose parts are of the same types, compiled
// once; the numbers are tables.
#pragma once

#include "codegen/module.hpp"

namespace navjit::codegen {

/// Whether code for this structure would know the kinds of solids that the library's own instance
/// asks for at run time.
bool gains_from_structure(const Geometry& geometry, const ScenePlan& plan);

/// How many solids the kernels of a structure are for: the time to compile it grows with that.
std::size_t solids_of_structure(const Geometry& geometry, const ScenePlan& plan);

/// The navigator of a scene's structure, and this scene's numbers as its data. Scenes of one
/// structure have the same source, to the letter.
Module generate_structure(const Geometry& geometry, const WorldFacts& facts, const ScenePlan& plan);

}  // namespace navjit::codegen
