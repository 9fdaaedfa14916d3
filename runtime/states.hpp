// States on which navigators are tried.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "geometry/navigation/geometry.hpp"
#include "navjit/detail/profile.hpp"

namespace navjit {

/// Finds touchables of a volume and makes up states in it. Deterministic for a seed.
class StateSampler {
 public:
  explicit StateSampler(const Geometry& geometry);

  /// A random touchable of the volume; false if the volume is not in the tree.
  bool touchable(VolumeId volume, std::mt19937_64& random, TouchableId& result) const;

  /// Up to `count` states inside the volume: points in its solid and on its daughters' faces, with
  /// directions at random and along the axes. If few such points are in the solid, as in thin
  /// shells, points on lines through it are used as well. There are fewer states if the solid is
  /// hard to hit.
  std::vector<Sample> states(VolumeId volume, std::size_t count, std::uint64_t seed) const;

 private:
  struct Placed {
    VolumeId mother;
    TouchableId offset;
  };
  const Geometry& geometry_;
  std::vector<std::vector<Placed>> placements_;  ///< by volume, a few
};

}  // namespace navjit
