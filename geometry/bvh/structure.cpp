#include "geometry/bvh/structure.hpp"

#include <array>

namespace navjit::bvh {
namespace {

constexpr std::array<std::string_view, 4> method_names{"linear", "two-level", "regular-tree",
                                                       "wide-tree"};
constexpr std::array<std::string_view, 3> clustering_names{"surface", "k-means", "furthest"};

template <class Value, std::size_t count>
bool parse(std::string_view text, const std::array<std::string_view, count>& names, Value& value) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] != text) continue;
    value = static_cast<Value>(i);
    return true;
  }
  return false;
}

bool has_clustering(Method method) {
  return method == Method::two_level || method == Method::regular_tree;
}

}  // namespace

// A single group is a wide tree of one node, whose nearest lane is found without a branch. For two
// groups a scan is as fast or faster; for more, the wide tree is faster than all others.
Structure default_method(std::size_t count) {
  return {count > 8 && count <= 16 ? Method::linear : Method::wide_tree, Clustering::surface};
}

// More parents cost every query, since it scans them all; fewer have more children to scan.
std::uint32_t default_groups_per_cluster(std::size_t count) {
  return count < 512 ? 1 : count < 2048 ? 2 : 4;
}

std::string to_string(const Structure& structure) {
  std::string name(method_names[static_cast<std::size_t>(structure.method)]);
  if (!has_clustering(structure.method)) return name;
  return name.append(":").append(clustering_names[static_cast<std::size_t>(structure.clustering)]);
}

std::optional<Structure> parse_structure(std::string_view text) {
  Structure structure;
  const std::size_t colon = text.find(':');
  if (!parse(text.substr(0, colon), method_names, structure.method)) return {};
  if (colon == std::string_view::npos) return structure;
  if (!has_clustering(structure.method)) return {};
  if (!parse(text.substr(colon + 1), clustering_names, structure.clustering)) return {};
  return structure;
}

}  // namespace navjit::bvh
