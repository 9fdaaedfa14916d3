// Equal volumes: their scenes differ only in names, so that one navigator serves them all. Files
// written by programs often have a volume with a name of its own for each copy of a part.
#pragma once

#include <span>
#include <vector>

#include "analysis/facts.hpp"

namespace navjit {

/// By volume: the lowest-numbered of the volumes with which it shares code. These have the same
/// solid and, at the same places, daughters that share code themselves. What else code may know of
/// a volume, its frame and its mother, is also the same for all of them, unless there are many
/// different cases: then one code handles all cases. A volume outside the tree shares with no
/// other.
///
/// `mothers_first`: the volumes in the tree, each after all volumes that it is placed in.
std::vector<VolumeId> equal_scenes(const Geometry& geometry, const WorldFacts& facts,
                                   std::span<const VolumeId> mothers_first);

/// The facts that all volumes of each group have in common, by the first of the group; needs
/// `first_equal` and `equals`.
std::vector<EqualFacts> facts_of_equals(const Geometry& geometry, const WorldFacts& facts);

}  // namespace navjit
