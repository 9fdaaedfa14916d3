// What may disappear within a budget: differences between materials that are nearly the same, and
// small volumes.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "observe/marks.hpp"

namespace navjit {

/// By material: how much of the budget's unit there is in each mm of a ray, or radiation lengths
/// for a relative budget. Negative if this is not known.
std::vector<double> material_rates(const World& world, Observation::Unit unit);

/// The length of the longest straight line in the world, mm.
double longest_path(const World& world);

/// An upper bound of the length of a straight line within the solid, mm.
double longest_chord(const Solid& solid);

/// The number of touchables of each volume.
std::vector<double> touchables_of(const World& world);

/// Materials that count as the same.
struct MaterialGroups {
  std::vector<std::uint32_t> group_of;  ///< by material
  double bound = 0;  ///< in the budget's unit: the most by which this changes any ray
};

/// Groups within which rates differ by no more than `budget` over the longest path. A point of a
/// ray is in one group, whichever material of the group is taken there. So the changes of all
/// groups together are at most the largest difference times the path. A relative budget holds for
/// every point: no rate of a group is larger than the smallest by more than that fraction. A
/// material that is not used, or whose rate is not known, is in a group of its own.
MaterialGroups group_materials(const World& world, double budget,
                               Observation::Unit unit = Observation::Unit::radiation_lengths);

/// By daughter and mother: the most by which a ray changes, in the budget's unit, if all these
/// daughters are filled with their mothers' material.
using SmallVolumes = std::map<std::pair<VolumeId, VolumeId>, double>;

/// Chooses volumes that may be filled with their mothers' material, such that the chords of all
/// their touchables in the world together change no ray by more than the budget. Volumes with the
/// most boundaries for their change come first. Observed volumes, regions, and volumes whose tags
/// differ from their mothers' are not chosen. For a relative budget nothing is chosen, since a ray
/// may go through little else.
SmallVolumes choose_small(const World& world, const Marks& marks, double budget,
                          Observation::Unit unit = Observation::Unit::radiation_lengths);

}  // namespace navjit
