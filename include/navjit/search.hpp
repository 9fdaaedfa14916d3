// How daughters are searched for; this changes no answer.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "navjit/detail/api.hpp"

namespace NAVJIT_API navjit {

namespace bvh {

/// How boxes are searched. After S. Wenzel et al., "Accelerating navigation in the VecGeom geometry
/// modeller".
enum class Method : std::uint8_t {
  linear,        ///< all groups of boxes, one after the other
  two_level,     ///< parents of clusters of a few groups, then those groups (BVH_h)
  regular_tree,  ///< as many levels as it takes, each node one group of eight (BVH_p)
  wide_tree,     ///< nodes of eight, each a box or a node below, cut by the surfaces of boxes
};

/// How boxes that lie close together are found; geometry/bvh/clustering.hpp.
enum class Clustering : std::uint8_t { surface, k_means, furthest };

/// How the boxes of a scene are arranged.
struct Structure {
  Method method = Method::linear;
  Clustering clustering = Clustering::surface;  ///< not for linear and wide_tree
  /// Groups of eight boxes in a cluster, 1 ... 8, for Method::two_level; 0: by the number of boxes.
  std::uint32_t groups_per_cluster = 0;

  friend bool operator==(const Structure&, const Structure&) = default;
};

}  // namespace bvh

/// How the generic navigator searches.
struct GeometryOptions {
  /// Forces one search for all scenes with daughters, for tests and measurements. All but
  /// `automatic` also search when a daughter is left, without neighbour lists, and compose the
  /// frames of touchables that a track is brought to.
  enum class Force : std::uint8_t { automatic, all, linear_boxes, bvh } force = Force::automatic;
  /// The box structure of all scenes that have enough daughters for one, whatever their number.
  /// Nothing: it is chosen by their number (docs/bvh.md). Changes no answer.
  std::optional<bvh::Structure> boxes{};
  /// The same for single volumes by name, with few daughters or many. Boxes where there were none
  /// may make safeties larger, but never too large.
  std::map<std::string, bvh::Structure> boxes_of{};
};

}  // namespace navjit
