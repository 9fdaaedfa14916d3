// What counts: which volumes a run observes, and which boundaries between volumes it sees.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/model/world.hpp"
#include "navjit/observation.hpp"

namespace navjit {

/// By volume. Only volumes of the tree are looked at.
struct Marks {
  /// What a volume is like: its material, its region and its tags, as a number. Volumes of the same
  /// number have no boundary that counts between them.
  std::vector<std::uint32_t> classes;
  /// Material and tags alone, without the region that a volume inherits.
  std::vector<std::uint32_t> own;
  std::vector<bool> observed;   ///< by name, or by SensDet
  std::vector<bool> heads;      ///< root volumes of regions
  std::vector<bool> ambiguous;  ///< in several regions, depending on the mother
};

/// Throws GeometryError if the observation names a volume that is not there.
Marks find_marks(const World& world, const Observation& observation);

/// Whether nobody sees the boundary between a daughter and its mother. The daughter's region is
/// then that of the mother.
inline bool invisible(const Marks& marks, VolumeId daughter, VolumeId mother) {
  return marks.own[daughter] == marks.own[mother] && !marks.observed[daughter] &&
         !marks.observed[mother] && !marks.heads[daughter];
}

}  // namespace navjit
