// What rays are aimed at.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/model/world.hpp"

namespace navjit {

/// Boxes in the world, equally likely each: of a logical volume the boxes around all its
/// touchables. With "auto" it is a single box, the one where most touchables are: from the world on
/// down into a daughter as long as one placement of it holds more than half of all touchables, and
/// there the box around the daughters. So the hall around a detector is left out, and so are
/// caverns and shieldings around the hall.
class Target {
 public:
  /// `aim` is the name of a logical volume, or "auto". Throws Error if no volume of
  /// that name is in the world's tree. The world has to outlive it.
  Target(const World& world, const std::string& aim);

  /// How many boxes there are.
  std::uint64_t boxes() const { return single_ ? 1 : below_[world_.top]; }

  /// A point of a box, in the world, mm. `box` counts from 0; u, v and w are from 0 to 1.
  Vec3 point(std::uint64_t box, double u, double v, double w) const;

 private:
  /// By volume: how many touchables of the volume aimed at are in the tree of one placement.
  void count(VolumeId volume, std::vector<bool>& counted);

  const World& world_;
  std::vector<bool> aimed_at_;        ///< by volume
  std::vector<std::uint64_t> below_;  ///< by volume
  /// By volume that has any below it: of its daughters, the sums of `below_` up to each.
  std::vector<std::vector<std::uint64_t>> sums_;

  bool single_ = false;
  Transformation frame_;  ///< of the single box
  Extent box_{};
};

}  // namespace navjit
