// Partitions of a scene into buckets.
#pragma once

#include <functional>
#include <span>

#include "analysis/scene_plan.hpp"

namespace navjit {

struct BucketLimits {
  std::size_t max_buckets = 4096;
  std::size_t max_members = 1U << 16;
  int max_per_axis = 256;
};

/// A daughter's box as it lies in the scene.
struct PlacedBox {
  Extent bounds;  ///< the box along the scene's axes around it, mm
  bool oblique = false;
  std::array<Vec3, 3> edges{};  ///< of an oblique box, from its centre to its faces, mm
};

PlacedBox placed_box(const Solid& solid, const Transformation& transformation);

/// Whether a daughter keeps farther from all of a box in the scene's frame than its margin: true
/// only if it is sure.
using Apart = std::function<bool(std::uint32_t daughter, const Extent& box)>;

/// What is done with a bucket's daughters: tested one by one, or by boxes in blocks.
enum class BucketUse : std::uint8_t { daughters, blocks };

/// Chooses axes and counts that leave few candidates a bucket. Boxes are in the scene's frame and
/// are inflated by `margin` (mm), which has to exceed any rounding of a position in the scene. A
/// daughter is in a bucket unless its box keeps apart from it, or `apart` says that it does.
Buckets make_buckets(const Extent& scene, std::span<const PlacedBox> boxes, double margin,
                     BucketUse use = BucketUse::daughters, const Apart& apart = {},
                     const BucketLimits& limits = {});

/// Mean over the scene's volume of the number of candidates, the measure that choices are made by.
double mean_candidates(const Buckets& buckets);

}  // namespace navjit
