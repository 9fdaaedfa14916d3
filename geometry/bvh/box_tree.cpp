#include "geometry/bvh/box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "geometry/bvh/clustering.hpp"
#include "geometry/bvh/rounding.hpp"
#include "geometry/bvh/wide_tree.hpp"

namespace navjit::bvh {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

constexpr BoxGroup empty_group() {
  BoxGroup group{};
  for (int row = 0; row < 6; ++row) {
    for (float& bound : group.bounds[row]) bound = row < 3 ? infinity : -infinity;
  }
  return group;
}

void check(const Extent& box) {
  for (const double bound : {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z}) {
    if (std::isnan(bound)) throw GeometryError("a bounding box has a bound that is not a number");
  }
}

void set_lane(BoxGroup& group, std::uint32_t lane, const Extent& box, double tolerance) {
  const double low[3] = {box.min.x, box.min.y, box.min.z};
  const double high[3] = {box.max.x, box.max.y, box.max.z};
  for (int axis = 0; axis < 3; ++axis) {
    // The float's margin is wide enough for the rounding of this sum, too.
    group.bounds[axis][lane] = float_below(low[axis] - tolerance);
    group.bounds[axis + 3][lane] = float_above(high[axis] + tolerance);
  }
}

/// Widens the box in `lane` of `parents` to hold all boxes of `children`.
void include(BoxGroup& parents, std::uint32_t lane, const BoxGroup& children) {
  for (int axis = 0; axis < 3; ++axis) {
    float& low = parents.bounds[axis][lane];
    float& high = parents.bounds[axis + 3][lane];
    for (const float bound : children.bounds[axis]) low = std::min(low, bound);
    for (const float bound : children.bounds[axis + 3]) high = std::max(high, bound);
  }
}

std::uint32_t groups_for(std::size_t boxes) {
  return static_cast<std::uint32_t>((boxes + group_width - 1) / group_width);
}

/// Brings `order` into an order in which, on every level of a regular tree, the boxes below a
/// parent are one cluster: all clusters but the last are full, so that no place is left over.
void order_for_tree(std::span<const Extent> boxes, Clustering clustering, std::size_t capacity,
                    std::span<std::uint32_t> order) {
  if (order.size() <= group_width) {
    std::sort(order.begin(), order.end());
    return;
  }
  while (capacity >= order.size()) capacity /= group_width;
  std::vector<Extent> members;
  for (const std::uint32_t i : order) members.push_back(boxes[i]);
  const Clusters clusters = cluster(clustering, members, static_cast<std::uint32_t>(capacity));
  std::vector<std::uint32_t> sorted;
  sorted.reserve(order.size());
  for (const std::uint32_t i : clusters.order) sorted.push_back(order[i]);
  std::copy(sorted.begin(), sorted.end(), order.begin());
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    order_for_tree(boxes, clustering, capacity,
                   order.subspan(clusters.begin[c], clusters.begin[c + 1] - clusters.begin[c]));
  }
}

std::vector<std::uint32_t> all_indices(std::size_t count) {
  std::vector<std::uint32_t> indices(count);
  std::iota(indices.begin(), indices.end(), 0u);
  return indices;
}

}  // namespace

BoxTree::BoxTree(std::span<const Extent> boxes, double tolerance, const Structure& structure)
    : size_(boxes.size()), structure_(structure) {
  if (boxes.size() >> 31 != 0) throw GeometryError("more than 2^31 bounding boxes");
  if (!(tolerance >= 0)) throw GeometryError("the tolerance of bounding boxes must be >= 0");
  std::for_each(boxes.begin(), boxes.end(), check);
  switch (structure.method) {
    case Method::linear: {
      const std::uint32_t begin[] = {0, static_cast<std::uint32_t>(boxes.size())};
      fill(boxes, tolerance, all_indices(boxes.size()), begin);
      break;
    }
    case Method::two_level:
      build_two_levels(boxes, tolerance);
      break;
    case Method::regular_tree:
      build_regular_tree(boxes, tolerance);
      break;
    case Method::wide_tree:
      build_wide_tree(boxes, tolerance);
      break;
  }
}

std::size_t BoxTree::clusters() const {
  switch (structure_.method) {
    case Method::linear:
      break;
    case Method::two_level:
      return first_group_.size() - 1;
    case Method::regular_tree:
    case Method::wide_tree:
      return groups_.size() - parent_groups_;
  }
  return 0;
}

void BoxTree::build_two_levels(std::span<const Extent> boxes, double tolerance) {
  std::uint32_t& per_cluster = structure_.groups_per_cluster;
  if (per_cluster == 0) per_cluster = default_groups_per_cluster(boxes.size());
  per_cluster = std::clamp(per_cluster, 1u, 8u);
  const Clusters clusters = cluster(structure_.clustering, boxes, per_cluster * group_width);
  parent_groups_ = groups_for(clusters.size());
  first_group_.reserve(clusters.size() + 1);
  first_group_.push_back(parent_groups_);
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    first_group_.push_back(first_group_.back() +
                           groups_for(clusters.begin[c + 1] - clusters.begin[c]));
  }
  groups_.assign(parent_groups_, empty_group());
  fill(boxes, tolerance, clusters.order, clusters.begin);
  for (std::uint32_t c = 0; c < clusters.size(); ++c) {
    for (std::uint32_t g = first_group_[c]; g < first_group_[c + 1]; ++g) {
      include(groups_[c / group_width], c % group_width, groups_[g]);
    }
  }
}

void BoxTree::build_regular_tree(std::span<const Extent> boxes, double tolerance) {
  if (boxes.empty()) return;
  std::vector<std::uint32_t> groups_of_level{groups_for(boxes.size())};  // from the leaves up
  std::size_t capacity = group_width;  // boxes below one lane of the root
  while (groups_of_level.back() > 1) {
    groups_of_level.push_back(groups_for(groups_of_level.back()));
    capacity *= group_width;
  }
  std::vector<std::uint32_t> order = all_indices(boxes.size());
  order_for_tree(boxes, structure_.clustering, capacity, order);

  parent_groups_ = std::accumulate(groups_of_level.begin() + 1, groups_of_level.end(), 0u);
  groups_.assign(parent_groups_, empty_group());
  const std::uint32_t begin[] = {0, static_cast<std::uint32_t>(boxes.size())};
  fill(boxes, tolerance, order, begin);

  std::uint32_t first_of_level = 0;
  for (std::size_t level = groups_of_level.size(); --level > 0;) {
    const std::uint32_t first_below = first_of_level + groups_of_level[level];
    for (std::uint32_t g = 0; g < groups_of_level[level]; ++g) {
      first_group_.push_back(first_below + g * group_width);
    }
    first_of_level = first_below;
  }
  first_group_.push_back(static_cast<std::uint32_t>(groups_.size()));
  for (std::uint32_t g = parent_groups_; g-- > 0;) {
    for (std::uint32_t child = first_group_[g]; child < first_group_[g + 1]; ++child) {
      include(groups_[g], child - first_group_[g], groups_[child]);
    }
  }
}

void BoxTree::build_wide_tree(std::span<const Extent> boxes, double tolerance) {
  static_assert(wide_tree_lanes == group_width);
  const std::vector<WideNode> nodes = bvh::build_wide_tree(boxes);
  groups_.assign(nodes.size(), empty_group());
  index_.assign(nodes.size() * group_width, no_box);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    for (std::uint32_t lane = 0; lane < nodes[n].count; ++lane) {
      const WideNode::Lane& from = nodes[n].lanes[lane];
      set_lane(groups_[n], lane, from.bounds, tolerance);
      index_[n * group_width + lane] = from.is_box ? from.number : from.number | is_group;
    }
  }
}

/// Appends the child groups of all clusters; each cluster begins with a new group.
void BoxTree::fill(std::span<const Extent> boxes, double tolerance,
                   std::span<const std::uint32_t> order, std::span<const std::uint32_t> begin) {
  for (std::size_t c = 0; c + 1 < begin.size(); ++c) {
    for (std::uint32_t i = begin[c]; i < begin[c + 1]; ++i) {
      const std::uint32_t lane = (i - begin[c]) % group_width;
      if (lane == 0) {
        groups_.push_back(empty_group());
        index_.insert(index_.end(), group_width, no_box);
      }
      set_lane(groups_.back(), lane, boxes[order[i]], tolerance);
      index_[index_.size() - group_width + lane] = order[i];
    }
  }
}

std::size_t BoxTree::bytes() const {
  return groups_.capacity() * sizeof(BoxGroup) + index_.capacity() * sizeof(index_[0]) +
         first_group_.capacity() * sizeof(first_group_[0]);
}

}  // namespace navjit::bvh
