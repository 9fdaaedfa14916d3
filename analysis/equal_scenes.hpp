// Equal volumes: their scenes differ in names alone, so that one navigator serves them all. Files
// that programs write often have a volume with a name of its own for each copy of a part.
#pragma once

#include <span>
#include <vector>

#include "analysis/facts.hpp"

namespace navjit {

/// By volume: the lowest-numbered of those that it shares code with. They have the same solid and,
/// at the same places, daughters that share code themselves. What else code may know of a volume,
/// its frame and its mother, is the same for all of them too, unless there are many cases of it:
/// then one code takes all cases. Volumes outside the tree are alone.
///
/// `mothers_first`: the volumes in the tree, each after all that it is placed in.
std::vector<VolumeId> equal_scenes(const Geometry& geometry, const WorldFacts& facts,
                                   std::span<const VolumeId> mothers_first);

/// What all volumes of each group have in common, by the first of each; needs `first_equal` and
/// `equals`.
std::vector<EqualFacts> facts_of_equals(const Geometry& geometry, const WorldFacts& facts);

}  // namespace navjit
