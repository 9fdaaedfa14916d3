// Volumes whose daughters may become one mixture with them, and what it is made of.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "observe/marks.hpp"

namespace navjit {

/// Which daughters may become part of their mothers, and what that makes.
class Mixtures {
 public:
  /// `rates`: as material_rates(). All have to outlive it.
  Mixtures(const World& world, const Marks& marks, const std::vector<double>& rates);

  /// By volume: the volumes of those daughters that may become part of it.
  const std::vector<std::set<VolumeId>>& possible() const { return possible_; }
  /// Why volumes that have daughters have none that may; a few words, empty for others.
  const std::vector<std::string>& why() const { return why_; }

  /// The rate of the mixture of a mother's own material with all daughters of these volumes.
  double rate(VolumeId mother, const std::set<VolumeId>& daughters) const;
  /// The mixture itself: mass and elements are those of what it takes the place of.
  Material material(VolumeId mother, const std::set<VolumeId>& daughters) const;

  /// By material, mm3.
  using Parts = std::map<std::uint32_t, double>;
  /// What the mixture is made of.
  Parts parts(VolumeId mother, const std::set<VolumeId>& daughters) const;

 private:
  bool may_disappear(VolumeId volume, VolumeId mother) const;

  const World& world_;
  const Marks& marks_;
  const std::vector<double>& rates_;
  std::vector<double> own_volume_;  ///< mm3: without daughters; negative where it is not known
  std::vector<std::map<VolumeId, double>> counts_;  ///< by mother: placements of each daughter
  std::vector<Parts> whole_;                        ///< with all below it
  std::vector<std::set<VolumeId>> possible_;
  std::vector<std::string> why_;
};

}  // namespace navjit
