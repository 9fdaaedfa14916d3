// Grouping of boxes that lie close together, for the levels of a box tree.
//
// All functions take boxes of any size, infinite, empty or degenerate ones included (no bound may
// be NaN), depend on the boxes and their order alone, and make the fewest clusters possible: all
// full but the last. A regular tree rests on that.
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

/// Boxes are divided in two again and again, across the axis and at the place that give the least
/// sum of (surface of the bounding box) * (clusters within), the surface-area heuristic of ray
/// tracing; only places that leave full clusters on one side are tried. Clusters that are close
/// together have close numbers. `capacity` > 0. O(n log^2 n).
Clusters cluster_by_surface(std::span<const Extent> boxes, std::uint32_t capacity);

/// Algorithm 1 of the paper: k-means on the boxes' centres, from centres drawn with a fixed seed
/// (k-means++); then clusters with too many members give those that are furthest from their centre
/// to the nearest cluster with room. `capacity` > 0. O(n k) with k clusters, times 16 at most.
Clusters cluster_by_k_means(std::span<const Extent> boxes, std::uint32_t capacity);

/// Algorithm 2 of the paper: the box whose centre is furthest from the mean of those left gathers
/// its nearest neighbours until the cluster is full, and so on. `capacity` > 0. O(n k).
Clusters cluster_by_furthest(std::span<const Extent> boxes, std::uint32_t capacity);

Clusters cluster(Clustering clustering, std::span<const Extent> boxes, std::uint32_t capacity);

/// The centre of a box, within 1e30 mm of the origin; 0 on axes where it has none.
Vec3 bounded_centre(const Extent& box);

}  // namespace navjit::bvh
