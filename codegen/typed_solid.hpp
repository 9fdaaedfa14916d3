// Solids as the types that generated code has for them: booleans of any solids become booleans of
// just these, with the same numbers.
#pragma once

#include "codegen/data/arena.hpp"
#include "geometry/solids/any_solid.hpp"

namespace navjit::codegen {

/// Whether the operand of a boolean keeps the box around it. A moved box is no dearer than the test
/// of its box.
bool keeps_box(const kernels::AnyOperand<double>& operand);

/// Of other solids.
bool is_composed(SolidKind kind);

/// The solid's numbers as an object of its Shapes::type. Where that is the solid's own, it is the
/// solid itself, else a copy in the arena.
const void* typed_shape(const kernels::AnySolid<double>& solid, Arena& arena);

/// How many numbers there are in a solid.
std::size_t numbers_of(const kernels::AnySolid<double>& solid);

}  // namespace navjit::codegen
