// The parts of a union of many, found by their boxes, eight boxes at once.
#pragma once

#include <span>
#include <vector>

#include "geometry/solids/box_blocks.hpp"
#include "geometry/solids/solid.hpp"

namespace navjit::kernels {

/// What a union is made of, beside the tree, which gives the same answers, bit for bit. The boxes
/// have a margin for single precision: they exclude only parts that the tree would exclude, too.
struct UnionParts {
  std::vector<AnyOperand<double>> operands;  ///< not owned; parts close together have close numbers
  std::vector<BoxBlock> blocks;              ///< lane l of block b: of operand b * box_lanes + l
  std::vector<BoxBlock> groups;  ///< lane l of group g is around block g * box_lanes + l
  double low[3], high[3];        ///< the box around all boxes, mm
  double margin;                 ///< that of the boxes, mm
};

/// `operands` are the same as `parts`, as operands of the tree, in the same order.
UnionParts make_union_parts(std::span<const Solid> parts, std::vector<AnyOperand<double>> operands);

}  // namespace navjit::kernels
