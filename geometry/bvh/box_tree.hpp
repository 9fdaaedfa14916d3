// Boxes in single precision, in groups of one SIMD width, that answer "which of these might a ray
// meet?" without ever missing one. After S. Wenzel et al., "Accelerating navigation in the VecGeom
// geometry modeller": a linear scan of all groups; two levels (BVH_h), where groups of parent boxes
// stand before clusters of a few groups of children; a regular tree of groups (BVH_p), where each
// lane is the parent of a whole group below. One structure is not from there: a tree whose lanes
// are boxes or groups, by the boxes' sizes (geometry/bvh/wide_tree.hpp). docs/bvh.md compares them.
//
// The traversals are templates in geometry/bvh/box_tree_traversal.hpp, which needs Vc and is slow
// to parse: include it where they are called, and compile all those places for the same
// instruction set.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/bvh/structure.hpp"
#include "geometry/solids/solid.hpp"

namespace navjit::bvh {

/// The number of boxes in a group, the same on every machine, and so are layout and visits.
constexpr std::uint32_t group_width = 8;

/// group_width boxes as structure of arrays; unused lanes hold boxes that nothing meets.
struct alignas(64) BoxGroup {
  float bounds[6][group_width];  ///< rows: min x, y, z, max x, y, z
};

/// Immutable after construction; any number of threads may traverse it.
///
/// Contract of all traversals: they miss no box that exact arithmetic would find among the boxes
/// inflated by the tolerance. They may visit others, too: float bounds reach out by at most 2^-22
/// of a coordinate. Points and boxes must stay within 1e30 mm of the origin (boxes may be
/// infinite), and directions must have unit length to 1e-3. A box with min > max on an axis is
/// empty: it may or may not be visited.
class BoxTree {
 public:
  BoxTree() = default;

  /// `boxes` and `tolerance` (>= 0) in mm, in the mother's frame. Throws GeometryError if a bound
  /// or the tolerance is not a number, or there are more than 2^31 boxes.
  BoxTree(std::span<const Extent> boxes, double tolerance, const Structure& structure);

  /// Calls visit(index, enter) for every box that the ray from `p` along `v` meets at a path length
  /// within [0, limit]. `enter` >= 0 is a lower bound of the path length at which the ray meets it.
  /// `visit` returns the limit from there on, at most the present one. A box met at exactly the
  /// limit is visited. The order is by `enter` within a cluster, and mostly so among clusters.
  template <class Visit>
  void along_ray(const Vec3& p, const Direction& v, double limit, Visit&& visit) const;

  /// Calls visit(index) for every box that contains `p`, until it returns false. Only for
  /// Method::linear is the order that of the boxes.
  template <class Visit>
  void containing(const Vec3& p, Visit&& visit) const;

  /// The same for every box that meets `box`.
  template <class Visit>
  void overlapping(const Extent& box, Visit&& visit) const;

  /// Calls visit(index, distance) for every box closer to `p` than `radius`, mm. `distance` >= 0 is
  /// a lower bound of the distance to the inflated box, 0 within it. `visit` returns the radius
  /// from there on, at most the present one. The order is as for along_ray.
  template <class Visit>
  void near(const Vec3& p, double radius, Visit&& visit) const;

  std::size_t size() const { return size_; }
  const Structure& structure() const { return structure_; }
  /// The number of clusters of the lowest level; 0 for Method::linear.
  std::size_t clusters() const;
  /// Memory held, bytes.
  std::size_t bytes() const;

 private:
  static constexpr std::uint32_t no_box = ~std::uint32_t{0};
  static constexpr std::uint32_t is_group = std::uint32_t{1} << 31;  ///< for Method::wide_tree

  std::uint32_t index_of(std::uint32_t group, std::uint32_t lane) const {
    return index_[std::size_t{group - parent_groups_} * group_width + lane];
  }

  template <class Test, class Visit>
  void nearest_first(const Test& test, double limit, const Visit& visit) const;
  template <class Test, class NumberOf, class Take>
  double scan(std::uint32_t first, std::uint32_t last, const Test& test, double limit,
              const NumberOf& number_of, const Take& take) const;

  template <class Test, class Visit>
  void visit_overlapping(const Test& test, const Visit& visit) const;

  /// For Method::regular_tree.
  template <class Test, class Visit>
  void descend(const Test& test, double limit, const Visit& visit) const;
  /// For Method::wide_tree.
  template <class Test, class Visit>
  void descend_wide(const Test& test, double limit, const Visit& visit) const;

  void build_two_levels(std::span<const Extent> boxes, double tolerance);
  void build_regular_tree(std::span<const Extent> boxes, double tolerance);
  void build_wide_tree(std::span<const Extent> boxes, double tolerance);
  void fill(std::span<const Extent> boxes, double tolerance, std::span<const std::uint32_t> order,
            std::span<const std::uint32_t> begin);

  std::vector<BoxGroup> groups_;  ///< parent groups, by level from the root; then the children's
  /// By lane of a child group, and in a wide tree of any group: the number of its box, or that of
  /// the group below, with is_group, where there is one.
  std::vector<std::uint32_t> index_;
  /// Two levels: the first group of each cluster. Regular tree: the first group below each parent
  /// group, whose lanes stand for that group and the next ones. One past the last is at the end.
  std::vector<std::uint32_t> first_group_;
  std::uint32_t parent_groups_ = 0;
  std::size_t size_ = 0;
  Structure structure_;
};

}  // namespace navjit::bvh
