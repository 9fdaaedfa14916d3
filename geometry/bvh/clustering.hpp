// Grouping of boxes that lie close together, for the lower level of a box tree.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/solids/solid.hpp"

namespace navjit::bvh {

/// A partition of box numbers: cluster c holds order[begin[c]] ... order[begin[c + 1] - 1], in
/// ascending order. Clusters that are close together have close numbers.
struct Clustering {
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> begin;

  std::size_t size() const { return begin.empty() ? 0 : begin.size() - 1; }
};

/// Clusters of at most `capacity` (> 0) boxes, all but the last ones of each branch full.
///
/// Boxes are divided in two again and again, across the axis and at the place that give the least
/// sum of (surface of the bounding box) * (clusters within), the surface-area heuristic of ray
/// tracing; only places that leave full clusters on one side are tried, so that n boxes make
/// ceil(n / capacity) clusters. Depends on the boxes and their order alone. O(n log^2 n).
Clustering cluster_by_surface(std::span<const Extent> boxes, std::uint32_t capacity);

}  // namespace navjit::bvh
