// Rings: daughters at equal steps of azimuth about an axis, in any order in the file, with gaps or
// without.
#pragma once

#include <optional>
#include <span>

#include "analysis/scene_plan.hpp"

namespace navjit {

/// The rings about the axis that leaves fewest daughters out; nothing if no axis has any. `margin`
/// in mm. Daughters that reach less than the margin into a sector are not in it.
std::optional<Rings> find_rings(const World& world, const Solid& mother,
                                std::span<const Daughter> daughters, double margin);

}  // namespace navjit
