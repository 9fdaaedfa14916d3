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
  /// Material and tags alone, without the region that a volume inherits; and tags alone.
  std::vector<std::uint32_t> own, tags;
  /// Tags without production thresholds, which follow from region and material.
  std::vector<std::uint32_t> settings;
  std::vector<bool> observed;   ///< by name, or by SensDet
  std::vector<bool> heads;      ///< root volumes of regions
  std::vector<bool> ambiguous;  ///< in several regions, depending on the mother
};

/// What Geant4 writes of each volume beside its material: thresholds in energy that it has derived
/// from the material and the region's cuts.
bool is_threshold(const Auxiliary& tag);

/// `group_of`: of each material; those of one group count as one. Empty: each is its own. Throws
/// GeometryError if the observation names a volume that is not there.
Marks find_marks(const World& world, const Observation& observation,
                 const std::vector<std::uint32_t>& group_of = {});

/// Whether nothing but the material changes between a daughter and its mother.
inline bool of_one_kind(const Marks& marks, VolumeId daughter, VolumeId mother) {
  return marks.tags[daughter] == marks.tags[mother] && !marks.observed[daughter] &&
         !marks.observed[mother] && !marks.heads[daughter];
}

/// Whether nobody sees the boundary between a daughter and its mother. The daughter's region is
/// then that of the mother.
inline bool invisible(const Marks& marks, VolumeId daughter, VolumeId mother) {
  return marks.own[daughter] == marks.own[mother] && of_one_kind(marks, daughter, mother);
}

}  // namespace navjit
