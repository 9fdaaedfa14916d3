// Binding to data: a navigator that was compiled with the library for all scenes of one structure,
// and the numbers of one scene beside it. It is ready at once and needs no compiler.
#pragma once

#include <string>

#include "analysis/facts.hpp"
#include "codegen/data/arena.hpp"
#include "codegen/data/code_of_solids.hpp"
#include "geometry/navigation/geometry.hpp"

namespace navjit::codegen {

/// Binds a scene to data, which is always possible: if no instance fits its solids, there is one
/// for solids of any kind. The entry and the numbers are in the arena. They refer to the Geometry,
/// and to `code` for solids of the scene that have code. All three must outlive the entry.
const kernels::DispatchEntry* bind_to_data(const Geometry& geometry, const ScenePlan& plan,
                                           Arena& arena, const CodeOfSolids* code = nullptr);

/// The types of the instance that a plan is bound to, in words: "unrotated box, slabs of boxes".
/// Scenes with the same words share their code.
std::string structure_of(const Geometry& geometry, const ScenePlan& plan);

}  // namespace navjit::codegen
