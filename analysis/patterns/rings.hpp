// Rings: daughters at equal steps of azimuth about an axis, in any order in the file, with gaps or
// without.
#pragma once

#include <optional>
#include <span>

#include "analysis/scene_plan.hpp"

namespace navjit {

/// The rings about the axis with the fewest daughters in none; nothing if no axis has a ring.
/// `margin` is in mm. A daughter that reaches into a sector by less than the margin is not in that
/// sector.
std::optional<Rings> find_rings(const World& world, const Solid& mother,
                                std::span<const Daughter> daughters, double margin);

}  // namespace navjit
