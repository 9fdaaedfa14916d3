// Binding to data: a navigator that was compiled ahead with the library, for all scenes of one
// structure, and the numbers of one scene beside it. Ready at once, without a compiler.
#pragma once

#include <string>

#include "analysis/facts.hpp"
#include "codegen/data/arena.hpp"
#include "codegen/data/code_of_solids.hpp"
#include "geometry/navigation/geometry.hpp"

namespace navjit::codegen {

/// Every scene has one: where no instance fits its solids, one that takes any solid does.
/// Record and numbers are in the arena, and use the Geometry, and `code` if solids of the scene
/// have any: all have to live longer.
const kernels::DispatchEntry* bind_to_data(const Geometry& geometry, const ScenePlan& plan,
                                           Arena& arena, const CodeOfSolids* code = nullptr);

/// The types of the instance that a plan is bound to, in words: "unrotated box, slabs of boxes".
/// Scenes with the same words share their code.
std::string structure_of(const Geometry& geometry, const ScenePlan& plan);

}  // namespace navjit::codegen
