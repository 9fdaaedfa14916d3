// What a budget lets disappear: differences between materials that are nearly the same, and small
// volumes.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "observe/marks.hpp"

namespace navjit {

/// By material: how much of the budget's unit there is in each mm of a ray; radiation lengths for a
/// relative budget. Negative where it is not known.
std::vector<double> material_rates(const World& world, Observation::Unit unit);

/// How long a straight line in the world can be, mm.
double longest_path(const World& world);

/// An upper bound of the length of a straight line within the solid, mm.
double longest_chord(const Solid& solid);

/// How many touchables of each volume there are.
std::vector<double> touchables_of(const World& world);

/// Materials that may stand for one another.
struct MaterialGroups {
  std::vector<std::uint32_t> group_of;  ///< by material
  double bound = 0;                     ///< in the unit: the most by which any ray changes by it
};

/// Groups within which rates differ by no more than `budget` over the longest path. A point of a
/// ray is in one group, whatever material of it is taken there: so the changes of all groups
/// together are bounded by the largest difference times the path. A relative budget is held point
/// by point: no rate of a group is larger than the least by more than that part of it. A material
/// whose rate is not known, or that is not used, is alone.
MaterialGroups group_materials(const World& world, double budget,
                               Observation::Unit unit = Observation::Unit::radiation_lengths);

/// By daughter and mother: how much a ray changes at the most, in the unit of a budget, if all
/// these daughters are filled with their mothers' material.
using SmallVolumes = std::map<std::pair<VolumeId, VolumeId>, double>;

/// Chooses volumes that may be filled with their mothers' material: the chords of all their
/// touchables in the world together change no ray by more than the budget. Those with the most
/// boundary for their change come first. Volumes that are observed, regions and volumes whose tags
/// are not their mothers' are not chosen. Nothing is chosen for a relative budget: a ray may go
/// through little else.
SmallVolumes choose_small(const World& world, const Marks& marks, double budget,
                          Observation::Unit unit = Observation::Unit::radiation_lengths);

}  // namespace navjit
