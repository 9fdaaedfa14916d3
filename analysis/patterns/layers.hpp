// Layers are slabs within slabs. Many calorimeters, muon systems and lattices are built in this
// way.
#pragma once

#include <optional>
#include <span>

#include "analysis/scene_plan.hpp"

namespace navjit {

/// The division of the daughters by planes along the axes that pass between them; nothing if such
/// planes hardly divide them. `boxes` are around the daughters, in the mother's frame, mm; `margin`
/// is added around each slab.
std::optional<Layers> find_layers(std::span<const Extent> boxes, double tolerance, double margin);

/// In words: "39 layers along z of 18 along x of 18 along y".
std::string describe_layers(const Layers& layers);

}  // namespace navjit
