// What a budget of radiation lengths lets disappear: materials that are nearly the same, and small
// volumes.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "observe/marks.hpp"

namespace navjit {

/// How long a straight line in the world can be, mm.
double longest_path(const World& world);

/// Materials that may stand for one another.
struct MaterialGroups {
  std::vector<std::uint32_t> group_of;  ///< by material
  double bound = 0;  ///< radiation lengths: the most by which any ray's budget changes by it
};

/// Groups within which inverse radiation lengths differ by no more than `budget` over the longest
/// path. A point of a ray is in one group, whatever material of it is taken there: so the changes
/// of all groups together are bounded by the largest difference times the path. A material of which
/// the radiation length is not known is alone, and one that is not used.
MaterialGroups group_materials(const World& world, double budget);

/// By daughter and mother: how much a ray's budget changes at the most, radiation lengths, if all
/// these daughters are filled with their mothers' material.
using SmallVolumes = std::map<std::pair<VolumeId, VolumeId>, double>;

/// Volumes whose chords, all touchables in the world together, change no ray's budget by more than
/// the budget. Those with the most boundary for their change come first. Volumes that are observed,
/// regions and volumes whose tags are not their mothers' are none.
SmallVolumes choose_small(const World& world, const Marks& marks, double budget);

}  // namespace navjit
