// What rays are aimed at.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/model/world.hpp"

namespace navjit {

/// Boxes in the world, each equally likely: the boxes around all touchables of a logical volume.
/// With "auto" it is a single box, the one where most touchables are. The way to it leads from the
/// world down into a daughter as long as one placement of it holds more than half of all
/// touchables; the box is that around the daughters there. This leaves out the hall around a
/// detector, and caverns and shieldings around the hall.
class Target {
 public:
  /// `aim` is the name of a logical volume, or "auto". Throws Error if no volume of
  /// that name is in the world's tree. The world has to outlive it.
  Target(const World& world, const std::string& aim);

  /// How many boxes there are.
  std::uint64_t boxes() const { return single_ ? 1 : below_[world_.top]; }

  /// A point in a box, in the world's frame, mm. `box` counts from 0; u, v and w are from 0 to 1.
  Vec3 point(std::uint64_t box, double u, double v, double w) const;

 private:
  /// Sets `below_`: how many touchables that are aimed at are in the tree of one placement.
  void count(VolumeId volume, std::vector<bool>& counted);

  const World& world_;
  std::vector<bool> aimed_at_;        ///< by volume
  std::vector<std::uint64_t> below_;  ///< by volume
  /// By volume with any below it: for its daughters, the sums of `below_` up to each.
  std::vector<std::vector<std::uint64_t>> sums_;

  bool single_ = false;
  Transformation frame_;  ///< of the single box
  Extent box_{};
};

}  // namespace navjit
