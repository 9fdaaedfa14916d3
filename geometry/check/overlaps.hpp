// Is the detector what its author meant? Daughters that reach into each other or out of their
// mother.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/navigation/geometry.hpp"

namespace navjit {

struct OverlapOptions {
  std::size_t resolution = 1000;  ///< points on the surface of each daughter
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
  double depth;          ///< a lower bound of how deep, mm
};

/// Checks every volume of the tree once: points on each daughter's surface must not be outside the
/// mother, nor inside another daughter (as G4PVPlacement::CheckOverlaps does). Sampling: what is
/// found is there, what is small may be missed. Sorted by volume, then daughters.
std::vector<Overlap> find_overlaps(const Geometry& geometry, const OverlapOptions& options = {});

}  // namespace navjit
