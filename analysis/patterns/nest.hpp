// Nests: daughters that surround an axis or a centre as shells, in any order in the file, with gaps
// or without.
#pragma once

#include <optional>
#include <span>

#include "analysis/scene_plan.hpp"

namespace navjit {

/// The shells about the axis or the centre that has most of them, and the other daughters; nothing
/// if there are fewer than three shells. A ray meets shells one after the other because both of
/// their radii ascend; they may overlap a little. `margin` (mm) is added on both sides.
std::optional<Nest> find_nest(const World& world, const Solid& mother,
                              std::span<const Daughter> daughters, double margin);

}  // namespace navjit
