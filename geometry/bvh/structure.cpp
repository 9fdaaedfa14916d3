#include "geometry/bvh/structure.hpp"

#include <array>

namespace navjit::bvh {
namespace {

constexpr std::array<std::string_view, 3> method_names{"linear", "two-level", "regular-tree"};
constexpr std::array<std::string_view, 3> clustering_names{"surface", "k-means", "furthest"};

template <class Value>
bool parse(std::string_view text, const std::array<std::string_view, 3>& names, Value& value) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] != text) continue;
    value = static_cast<Value>(i);
    return true;
  }
  return false;
}

}  // namespace

// For what a step asks, one ray to its first hit and one containing: from 17 to 24 boxes it makes
// little difference, from 32 on the tree is ahead or close. Two levels are better at `near`, which
// no step asks, from 32 to 128 boxes. Neither of the paper's clusterings is reliably better.
Structure default_method(std::size_t count) {
  return {count <= 20 ? Method::linear : Method::regular_tree, Clustering::surface};
}

// Parents, which every query scans, against children.
std::uint32_t default_groups_per_cluster(std::size_t count) {
  return count < 512 ? 1 : count < 2048 ? 2 : 4;
}

std::string to_string(const Structure& structure) {
  std::string name(method_names[static_cast<std::size_t>(structure.method)]);
  if (structure.method == Method::linear) return name;
  return name.append(":").append(clustering_names[static_cast<std::size_t>(structure.clustering)]);
}

std::optional<Structure> parse_structure(std::string_view text) {
  Structure structure;
  const std::size_t colon = text.find(':');
  if (!parse(text.substr(0, colon), method_names, structure.method)) return {};
  if (colon == std::string_view::npos) return structure;
  if (structure.method == Method::linear) return {};
  if (!parse(text.substr(colon + 1), clustering_names, structure.clustering)) return {};
  return structure;
}

}  // namespace navjit::bvh
