// Volumes whose daughters may become one mixture with them, and the materials of these mixtures.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "observe/marks.hpp"

namespace navjit {

/// Solids that overlap by less than this, mm, count as apart, wherever volumes are joined. It must
/// not be less than the rounding of positions in the world.
constexpr double least_overlap = 1e-9;

/// Which daughters may become part of their mothers' mixtures, and which materials result.
class Mixtures {
 public:
  /// `rates`: as returned by material_rates(). All arguments must outlive this object.
  Mixtures(const World& world, const Marks& marks, const std::vector<double>& rates);

  /// By volume: the volumes of the daughters that may become part of its mixture.
  const std::vector<std::set<VolumeId>>& possible() const { return possible_; }
  /// Why a volume that has daughters has none that may; a few words, empty for other volumes.
  const std::vector<std::string>& why() const { return why_; }

  /// The rate of the mixture of a mother's own material with all daughters of these volumes.
  double rate(VolumeId mother, const std::set<VolumeId>& daughters) const;
  /// The mixture itself. It has the mass and the elements of all that it replaces.
  Material material(VolumeId mother, const std::set<VolumeId>& daughters) const;

  /// Volumes by material, mm3.
  using Parts = std::map<std::uint32_t, double>;
  /// The materials of which the mixture is made.
  Parts parts(VolumeId mother, const std::set<VolumeId>& daughters) const;

 private:
  bool may_disappear(VolumeId volume, VolumeId mother) const;

  const World& world_;
  const Marks& marks_;
  const std::vector<double>& rates_;
  std::vector<double> own_volume_;  ///< mm3, without daughters; negative if not known
  std::vector<std::map<VolumeId, double>> counts_;  ///< by mother: placements of each daughter
  std::vector<Parts> whole_;                        ///< by volume, including all volumes below it
  std::vector<std::set<VolumeId>> possible_;
  std::vector<std::string> why_;
};

}  // namespace navjit
