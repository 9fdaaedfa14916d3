// Boxes around what is placed in a mother.
#pragma once

#include <span>

#include "geometry/model/world.hpp"

namespace navjit {

/// The box around a placed solid in its mother's frame, mm.
Extent placed_extent(const Solid& solid, const Transformation& transformation);

/// Half lengths of the smallest box about the origin that holds all of these placements, mm.
Vec3 half_lengths_around(const World& world, std::span<const Placement> placements);

}  // namespace navjit
