// The detector: solids, logical volumes and their placements, as a tree of touchables below the
// world volume. Immutable once built; shared by all threads.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "geometry/model/transformation.hpp"
#include "geometry/solids/solid.hpp"
#include "navjit/material.hpp"
#include "navjit/volume.hpp"

namespace navjit {

/// How near to a face a point counts as on it, mm. It is absolute, or relative to the world's size
/// (the largest coordinate in it), whichever is larger (docs/tolerance.md).
struct Tolerance {
  double absolute = 1e-11;
  double relative = 4e-15;
};

struct World {
  std::vector<LogicalVolume> volumes;
  std::vector<Material> materials;
  std::vector<Element> elements;
  std::vector<Isotope> isotopes;
  Auxiliaries auxiliaries;  ///< tags of the whole file: GDML's <userinfo>
  VolumeId top = 0;
  Tolerance tolerance_rule;
  double tolerance = 0;  ///< mm, from the rule and the world's extent. Set by finish().
  int depth = 0;         ///< levels of the tree, 1 for a lone world volume. Set by finish().
};

/// The deepest tree that is navigated; a deeper one is an error.
constexpr int max_depth = 64;

/// Checks a world that was filled in and sets what is derived: offsets of touchables, tolerance,
/// depth. Volumes that cannot be reached from `top` are kept, but not navigated. Touchables count
/// in preorder: the top is 0, and a daughter follows the trees of those before it.
/// Throws GeometryError on a cycle (the message names the volumes), a tree deeper than max_depth or
/// with more than 2^62 touchables, or a placement of a volume that does not exist.
void finish(World& world);

/// Whether finish() was called, and nothing that it checks or sets has changed since: navigation
/// relies on that.
bool is_finished(const World& world);
/// Throws GeometryError if there is no world, or if it is not finished.
void require_finished(const World* world);

/// The radiation length of a mixture of the world's elements, g/cm2; 0 where it is not known.
double radiation_length(const World& world, std::span<const ElementShare> shares);

/// "world/mother/daughter": the top volume's name, then placement names down to the touchable.
/// Throws UsageError where the world has no such touchable.
std::string path_of(const World& world, TouchableId touchable);

}  // namespace navjit
