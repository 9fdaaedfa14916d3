// Grouping of boxes that lie close together, for the levels of a box tree.
//
// All functions take boxes of any size, also infinite, empty or degenerate ones (no bound may be
// NaN). The result depends only on the boxes and their order, and has the fewest clusters possible:
// all are full but the last. A regular tree relies on that.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/bvh/structure.hpp"
#include "geometry/solids/solid.hpp"

namespace navjit::bvh {

/// A partition of box numbers: cluster c holds order[begin[c]] ... order[begin[c + 1] - 1], in
/// ascending order.
struct Clusters {
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> begin;

  std::size_t size() const { return begin.empty() ? 0 : begin.size() - 1; }
};

/// Divides the boxes in two again and again, across the axis and at the place that give the least
/// sum of (surface of the bounding box) * (clusters within), the surface-area heuristic of ray
/// tracing. It tries only places that leave full clusters on one side. Clusters that are close
/// together have close numbers. `capacity` > 0. O(n log^2 n).
Clusters cluster_by_surface(std::span<const Extent> boxes, std::uint32_t capacity);

/// Algorithm 1 of the paper (box_tree.hpp): k-means on the boxes' centres, from centres drawn with
/// a fixed seed (k-means++); then clusters with too many members give those furthest from their
/// centre to the nearest cluster with room. `capacity` > 0. O(n k), k clusters, times 16 at most.
Clusters cluster_by_k_means(std::span<const Extent> boxes, std::uint32_t capacity);

/// Algorithm 2 of that paper: the box whose centre is furthest from the mean of those left gathers
/// its nearest neighbours until the cluster is full, and so on. `capacity` > 0. O(n k).
Clusters cluster_by_furthest(std::span<const Extent> boxes, std::uint32_t capacity);

Clusters cluster(Clustering clustering, std::span<const Extent> boxes, std::uint32_t capacity);

/// The centre of a box, kept within 1e30 mm of the origin; 0 on axes where it has none.
Vec3 bounded_centre(const Extent& box);

}  // namespace navjit::bvh
