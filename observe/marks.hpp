// Which volumes a run observes, and which boundaries between volumes count for it.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/model/world.hpp"
#include "navjit/observation.hpp"

namespace navjit {

/// Properties by volume, only for volumes of the tree.
struct Marks {
  /// A number for the combination of a volume's material, region and tags. Between volumes of the
  /// same number there is no boundary that counts.
  std::vector<std::uint32_t> classes;
  /// The same for material and tags, without the region that a volume inherits; and for tags only.
  std::vector<std::uint32_t> own, tags;
  /// The same for tags without production thresholds, which follow from region and material.
  std::vector<std::uint32_t> settings;
  std::vector<bool> observed;   ///< by name, or by SensDet
  std::vector<bool> heads;      ///< root volumes of regions
  std::vector<bool> ambiguous;  ///< in several regions, depending on the mother
};

/// Whether Geant4 wrote this tag of a volume besides its material: a threshold in energy that it
/// derived from the material and the region's cuts.
bool is_threshold(const Auxiliary& tag);

/// `group_of`: by material, its group; all materials of a group count as one. If empty, each
/// material is its own group. Throws GeometryError if the observation names a volume that does not
/// exist.
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
