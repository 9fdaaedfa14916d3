// Which box structure a set of boxes gets: method, clustering, size of clusters; their names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace navjit::bvh {

/// How boxes are searched. After S. Wenzel et al., "Accelerating navigation in the VecGeom geometry
/// modeller".
enum class Method : std::uint8_t {
  linear,        ///< all groups of boxes, one after the other
  two_level,     ///< parents of clusters of a few groups, then those groups (BVH_h)
  regular_tree,  ///< as many levels as it takes, each node one group of eight (BVH_p)
};

/// How neighbours are found; geometry/bvh/clustering.hpp.
enum class Clustering : std::uint8_t { surface, k_means, furthest };

struct Structure {
  Method method = Method::linear;
  Clustering clustering = Clustering::surface;  ///< not for Method::linear
  /// Groups of eight boxes in a cluster, 1 ... 8, for Method::two_level; 0 chooses by the count.
  std::uint32_t groups_per_cluster = 0;

  friend bool operator==(const Structure&, const Structure&) = default;
};

/// The structure that is fastest for `count` boxes, as measured (docs/bvh.md).
Structure default_method(std::size_t count);

/// What stands for groups_per_cluster == 0.
std::uint32_t default_groups_per_cluster(std::size_t count);

/// "linear", "two-level:surface", "regular-tree:k-means", ...
std::string to_string(const Structure& structure);

/// The inverse; ":surface" may be left out. Nothing for any other text.
std::optional<Structure> parse_structure(std::string_view text);

}  // namespace navjit::bvh
