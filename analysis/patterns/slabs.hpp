// Slabs: daughters that follow one another along an axis, in any order in the file, with gaps or
// without. Their other dimensions are arbitrary.
#pragma once

#include <optional>
#include <span>

#include "analysis/scene_plan.hpp"

namespace navjit {

/// The slabs along the axis that separates all daughters; nothing if no axis does. `boxes` and
/// `scene` are in the mother's frame, mm; `margin` is added around each box.
std::optional<Slabs> find_slabs(const Extent& scene, std::span<const Extent> boxes,
                                double tolerance, double margin);

/// Fills in the cells of slabs whose bounds are known: `cells` of them between two positions (mm).
/// A cell says where the search for a ray from within it begins.
void divide_into_cells(Slabs& slabs, double from, double to, std::size_t cells);

}  // namespace navjit
