// Nests: daughters in layers about an axis or a centre, in any order in the file, with gaps or
// without.
#pragma once

#include <optional>
#include <span>

#include "analysis/scene_plan.hpp"

namespace navjit {

/// The layers about the axis or the centre that has most of them, and what else there is; nothing
/// if there are fewer than three. A ray meets layers one after the other as both of their radii
/// ascend; they may overlap a little. `margin` (mm) is added on both sides.
std::optional<Nest> find_nest(const World& world, const Solid& mother,
                              std::span<const Daughter> daughters, double margin);

}  // namespace navjit
