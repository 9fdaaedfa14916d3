// Layers: slabs within slabs, as many calorimeters, muon systems and lattices are built.
#pragma once

#include <optional>
#include <span>

#include "analysis/scene_plan.hpp"

namespace navjit {

/// How planes along the axes that pass between daughters divide them; nothing if they hardly do.
/// `boxes` around the daughters, in mm in the mother's frame; `margin` is added around each slab.
std::optional<Layers> find_layers(std::span<const Extent> boxes, double tolerance, double margin);

/// In words: "39 layers along z of 18 along x of 18 along y".
std::string describe_layers(const Layers& layers);

}  // namespace navjit
