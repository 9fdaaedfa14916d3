// A tree of boxes with nodes of uneven depth: each lane of a node is a box or another node.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/solids/solid.hpp"

namespace navjit::bvh {

constexpr std::uint32_t wide_tree_lanes = 8;

/// No path from the root has more nodes than this.
constexpr std::uint32_t wide_tree_levels = 28;

struct WideNode {
  struct Lane {
    Extent bounds;         ///< of the box, or of all boxes below
    std::uint32_t number;  ///< of the box or of the node, which comes later
    bool is_box;
  };
  Lane lanes[wide_tree_lanes];
  std::uint32_t count = 0;  ///< the number of lanes in use
};

/// The root comes first; there are no nodes for no boxes. Ranges of boxes are cut in two where the
/// sum of (surface of the bounding box) * (nodes for the boxes within) is least, the surface-area
/// heuristic of ray tracing. The boxes are in order of their centres along each axis, or of their
/// surface: so what is far larger than the rest is cut off at once. A node takes the cuts of its
/// largest parts until its lanes are full. Boxes may have any size, also infinite or empty; no
/// bound may be NaN. O(n log n) where the cuts are even.
std::vector<WideNode> build_wide_tree(std::span<const Extent> boxes);

}  // namespace navjit::bvh
