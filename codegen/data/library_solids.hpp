// Solids made of several whose structure is common: their code is compiled with the library, so
// that scenes that are bound to data have it at once, and no compiler is needed for it.
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

/// Whether the library has code for it.
bool is_in_library(const kernels::AnySolid<double>& solid);

/// The structures that it has code for: types of namespace navjit::kernels, as Shapes::type() has
/// them.
std::vector<std::string> library_structures();

}  // namespace navjit::codegen
