// Is the detector what its author meant? Daughters that reach into each other or out of their
// mother.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/navigation/geometry.hpp"

namespace navjit {

struct OverlapOptions {
  std::size_t resolution = 1000;  ///< points on the surface of each daughter; half as many within
  double tolerance = 1e-6;        ///< mm; shallower ones are not reported
  std::uint64_t seed = 1;
};

/// The deepest point found of one pair, or of one daughter and its mother.
struct Overlap {
  static constexpr std::uint32_t mother = ~std::uint32_t{0};

  VolumeId volume;       ///< the mother
  std::uint32_t first;   ///< index of a daughter
  std::uint32_t second;  ///< index of a later daughter, or Overlap::mother: sticks out of it
  Vec3 point;            ///< in the mother's frame, mm
  double depth;          ///< a lower bound of how far they have to be moved apart, or back, mm
};

struct OverlapReport {
  std::vector<Overlap> overlaps;  ///< sorted by volume, then daughters
  /// Mother and index of daughters no point of which was found, so thin are they in their boxes:
  /// nothing is known of them.
  std::vector<std::pair<VolumeId, std::uint32_t>> not_sampled;
};

/// Checks every volume of the tree once: points on each daughter's surface (as
/// G4PVPlacement::CheckOverlaps has them) and points within it must not be outside the mother, nor
/// inside another daughter; then, for each pair of daughters whose boxes meet, lines aimed at where
/// they do. So daughters that coincide are found, and thin ones that cross. A daughter that fills
/// its mother is none. Sampling: what is found is there, what is small may be missed.
OverlapReport check_overlaps(const Geometry& geometry, const OverlapOptions& options = {});

}  // namespace navjit
