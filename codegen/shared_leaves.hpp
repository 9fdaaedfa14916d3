// Which leaves of a module share their code (geometry/kernels/shared_leaf.h).
#pragma once

#include <span>
#include <vector>

#include "analysis/facts.hpp"
#include "codegen/scene_types.hpp"

namespace navjit::codegen {

/// Whether a scene is a leaf whose solid gains little from having its numbers as constants: a box
/// or a tube.
bool may_share_code(const Scene& scene);

/// Groups of those leaves, given by their plans, whose code is the same except for the numbers of
/// their solids and frames. What the code does with the mother must be the same, too. Each group
/// has two leaves or more, in the order given.
std::vector<std::vector<VolumeId>> leaves_that_share(const Geometry& geometry,
                                                     const WorldFacts& facts,
                                                     std::span<const ScenePlan* const> leaves,
                                                     const Neighbours& neighbours);

}  // namespace navjit::codegen
