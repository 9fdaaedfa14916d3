// Which scenes earlier runs of a detector found hot, and compiled together: kept in the cache, so
// that the next run need not wait for its own profile, and asks for the same modules.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/model/world.hpp"

namespace navjit {

/// Batches of volumes, as they were compiled.
using HotList = std::vector<std::vector<VolumeId>>;

std::string write_hot_list(const HotList& list);

/// Nothing if the text is not a hot list for `volumes` volumes: every number is checked, and none
/// may occur twice.
std::optional<HotList> read_hot_list(std::string_view text, std::size_t volumes);

/// `mine`, and the batches of `others` that share no volume with it.
HotList merge(const HotList& mine, const HotList& others);

}  // namespace navjit
