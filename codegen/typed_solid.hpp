// Solids as the types that generated code has for them. A boolean of solids of any kind becomes a
// boolean of exactly these types, with the same numbers.
#pragma once

#include <cstdint>

#include "codegen/data/arena.hpp"
#include "geometry/solids/any_solid.hpp"

namespace navjit::codegen {

/// Whether the operand of a boolean keeps the box around it. A box that is moved but not rotated
/// does not, because it costs no more than the test of its box.
bool keeps_box(const kernels::AnyOperand<double>& operand);

/// Whether solids of this kind are made of other solids.
bool is_composed(SolidKind kind);

/// The solid's numbers as an object of its Shapes::type. If the solid already has that type, this
/// is the solid itself, otherwise a copy in the arena.
const void* typed_shape(const kernels::AnySolid<double>& solid, Arena& arena);

/// How many solids the solid is composed of; 1 for one that is not composed.
std::size_t solids_in(const kernels::AnySolid<double>& solid);

/// Which operands of a boolean have kernels that are not inlined. Each kernel of a boolean calls
/// several kernels of its operands. If all were inlined in one another, their number would multiply
/// with each level.
enum class Apart : std::uint8_t {
  large,  ///< operands of three solids or more
  all,    ///< all except boxes; operands of one type share functions
};
bool is_apart(const kernels::AnySolid<double>& operand, Apart which);

/// Which operands are not inlined in a solid that is compiled alone. It is all of them if the solid
/// is made of more than eight solids, or of more than four of which one has much code itself:
/// compiling it inlined takes longer than that gains (docs/experiments.md).
Apart apart_in(const kernels::AnySolid<double>& solid);

/// Whether a solid has so many numbers that they are not made constants. The compiler would take
/// longer than constants gain.
bool is_large(const kernels::AnySolid<double>& solid);

}  // namespace navjit::codegen
