// Solids as the types that generated code has for them: booleans of any solids become booleans of
// just these, with the same numbers.
#pragma once

#include <cstdint>

#include "codegen/data/arena.hpp"
#include "geometry/solids/any_solid.hpp"

namespace navjit::codegen {

/// Whether the operand of a boolean keeps the box around it. A box that is moved and not turned is
/// no dearer than the test of its box, and keeps none.
bool keeps_box(const kernels::AnyOperand<double>& operand);

/// Whether solids of this kind are made of other solids.
bool is_composed(SolidKind kind);

/// The solid's numbers as an object of its Shapes::type. Where that is the solid's own, it is the
/// solid itself, else a copy in the arena.
const void* typed_shape(const kernels::AnySolid<double>& solid, Arena& arena);

/// How many solids it is composed of; one if it is not.
std::size_t solids_in(const kernels::AnySolid<double>& solid);

/// Which operands of a boolean have kernels that are functions of their own. Each kernel of a
/// boolean calls several of its operands': inlined in one another, they would be multiplied with
/// each level.
enum class Apart : std::uint8_t {
  large,  ///< those of three solids and more
  all,    ///< all but boxes; those of one type share functions
};
bool is_apart(const kernels::AnySolid<double>& operand, Apart which);

/// Which operands are apart in a solid that is compiled alone: if it is made of more than eight
/// solids, or of more than four with one that is much code itself, compiling it inlined takes
/// longer than that gains (docs/experiments.md).
Apart apart_in(const kernels::AnySolid<double>& solid);

/// Whether there are so many numbers in a solid that they are not made constants: the compiler
/// would take longer than folding gains.
bool is_large(const kernels::AnySolid<double>& solid);

}  // namespace navjit::codegen
