// Plain solids, and solids made of several whose structure is common: their code is compiled with
// the library, so that scenes that are bound to data have it at once, and no compiler is needed.
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

/// The same for a solid that is not made of others, of the commonest kinds but boxes; null for
/// those that have none.
const kernels::SolidCode* plain_code(const kernels::AnySolid<double>& solid, double tolerance,
                                     Arena& arena);

/// Whether the library has code for it.
bool is_in_library(const kernels::AnySolid<double>& solid);

/// The structures that it has code for: types of namespace navjit::kernels, as Shapes::type() has
/// them.
std::vector<std::string> library_structures();

}  // namespace navjit::codegen
