// Whether a detector is what its author meant: finds daughters that reach into each other or out of
// their mother.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/navigation/geometry.hpp"

namespace navjit {

struct OverlapOptions {
  std::size_t resolution = 1000;  ///< points on the surface of each daughter; half as many within
  double tolerance = 1e-6;        ///< mm; shallower overlaps are not reported
  std::uint64_t seed = 1;
};

/// The deepest point that was found for one pair, or for one daughter and its mother.
struct Overlap {
  static constexpr std::uint32_t mother = ~std::uint32_t{0};

  VolumeId volume;       ///< the mother
  std::uint32_t first;   ///< index of a daughter
  std::uint32_t second;  ///< index of a later daughter, or Overlap::mother if `first` sticks out
  Vec3 point;            ///< in the mother's frame, mm
  double depth;          ///< a lower bound of how far they have to be moved apart, or back, mm
};

struct OverlapReport {
  std::vector<Overlap> overlaps;  ///< sorted by volume, then daughters
  /// Mother and index of daughters of which no point was found, so thin are they in their boxes:
  /// nothing is known about them.
  std::vector<std::pair<VolumeId, std::uint32_t>> not_sampled;
};

/// Checks every volume of the tree once. Points on each daughter's surface (as
/// G4PVPlacement::CheckOverlaps takes them) and points within it must not be outside the mother,
/// nor inside another daughter. Then, for each pair of daughters whose boxes meet, lines are aimed
/// at where they do: they find daughters that coincide, and thin ones that cross. A daughter that
/// fills its mother is no overlap. This is sampling: small overlaps may be missed.
OverlapReport check_overlaps(const Geometry& geometry, const OverlapOptions& options = {});

}  // namespace navjit
