// Partitions a scene into the cells of a grid.
#pragma once

#include <functional>
#include <span>

#include "analysis/scene_plan.hpp"

namespace navjit {

struct GridLimits {
  std::size_t max_cells = 4096;
  std::size_t max_members = 1U << 16;
  int max_per_axis = 256;
};

/// The box of a daughter's solid as it lies in the scene.
struct PlacedBox {
  Extent bounds;  ///< the box along the scene's axes around it, mm
  bool oblique = false;
  std::array<Vec3, 3> edges{};  ///< if oblique: vectors from the centre to the faces, mm
};

PlacedBox placed_box(const Solid& solid, const Transformation& transformation);

/// Whether a daughter is farther than the margin from all of a box in the scene's frame; false if
/// this is not certain.
using Apart = std::function<bool(std::uint32_t daughter, const Extent& box)>;

/// What is done with a cell's daughters: tested one by one, or by boxes in blocks.
enum class CellUse : std::uint8_t { daughters, blocks };

/// Chooses axes and counts such that cells have few candidates. Boxes are in the scene's frame and
/// are inflated by `margin` (mm), which has to exceed any rounding of a position in the scene. A
/// daughter is in a cell unless its box does not reach into the cell, or `apart` says that the
/// daughter does not.
Grid make_grid(const Extent& scene, std::span<const PlacedBox> boxes, double margin,
               CellUse use = CellUse::daughters, const Apart& apart = {},
               const GridLimits& limits = {});

/// The number of candidates in a cell, as a mean over the scene's volume. Choices are made by this
/// number.
double mean_candidates(const Grid& grid);

}  // namespace navjit
