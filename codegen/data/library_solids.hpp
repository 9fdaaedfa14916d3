// Plain solids, and composed solids whose structure is common. Their code is compiled with the
// library, so that scenes that are bound to data have it at once and without a compiler.
#pragma once

#include <string>
#include <vector>

#include "codegen/data/arena.hpp"
#include "codegen/data/quick_solid.hpp"

namespace navjit::codegen {

/// Code for the solid, with its numbers and the tolerance (mm), in the arena; null if the library
/// has none for its structure. The solid has to live as long as the arena.
const kernels::SolidCode* library_code(const kernels::AnySolid<double>& solid, double tolerance,
                                       Arena& arena);

/// The same for a plain solid of one of the commonest kinds, except boxes; null for other solids.
const kernels::SolidCode* plain_code(const kernels::AnySolid<double>& solid, double tolerance,
                                     Arena& arena);

/// Whether library_code() has code for the solid.
bool is_in_library(const kernels::AnySolid<double>& solid);

/// The structures for which library_code() has code, as types of namespace navjit::kernels in the
/// spelling of Shapes::type().
std::vector<std::string> library_structures();

}  // namespace navjit::codegen
