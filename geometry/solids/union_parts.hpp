// The parts of a union of many, found by their boxes, eight at once.
#pragma once

#include <span>
#include <vector>

#include "geometry/navigation/box_blocks.hpp"
#include "geometry/solids/solid.hpp"

namespace navjit::kernels {

/// What a union is made of, beside the tree that has the same answers, bit by bit. The boxes have a
/// margin for single precision: they only leave out parts that a look at them would leave out.
struct UnionParts {
  std::vector<AnyOperand<double>> operands;  ///< not owned; neighbours are close together
  std::vector<BoxBlock> blocks;              ///< lane l of block b: of operand b * box_lanes + l
  std::vector<BoxBlock> groups;  ///< lane l of group g is around block g * box_lanes + l
  double low[3], high[3];        ///< around all boxes, mm
  double margin;                 ///< of the boxes, mm
};

/// `operands` are what `parts` are in the tree, in its order.
UnionParts make_union_parts(std::span<const Solid> parts, std::vector<AnyOperand<double>> operands);

}  // namespace navjit::kernels
