// Partitions of a scene into buckets.
#pragma once

#include <span>

#include "analysis/scene_plan.hpp"

namespace navjit {

struct BucketLimits {
  std::size_t max_buckets = 4096;
  std::size_t max_members = 1U << 16;
  int max_per_axis = 256;
};

/// Chooses axes and counts that leave few candidates a bucket. Boxes are in the scene's frame and
/// are inflated by `margin` (mm), which has to exceed any rounding of a position in the scene.
Buckets make_buckets(const Extent& scene, std::span<const Extent> boxes, double margin,
                     const BucketLimits& limits = {});

/// Mean over the scene's volume of the number of candidates, the measure that choices are made by.
double mean_candidates(const Buckets& buckets);

}  // namespace navjit
