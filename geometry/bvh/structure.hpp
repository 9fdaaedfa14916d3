// Which box structure a set of boxes gets: method, clustering and size of clusters, by name too.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "navjit/search.hpp"

namespace navjit::bvh {

/// The structure that is fastest for `count` boxes, as measured (docs/bvh.md).
Structure default_method(std::size_t count);

/// The size of clusters that groups_per_cluster == 0 stands for.
std::uint32_t default_groups_per_cluster(std::size_t count);

/// "linear", "two-level:surface", "regular-tree:k-means", ...
std::string to_string(const Structure& structure);

/// The inverse of to_string(); ":surface" may be left out. Nothing for any other text.
std::optional<Structure> parse_structure(std::string_view text);

}  // namespace navjit::bvh
