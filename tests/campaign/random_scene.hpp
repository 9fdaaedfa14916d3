// Random worlds of rotated solids that do not touch, as GDML that any engine can read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace navjit::campaign {

/// The kinds of solids, by the names that random_scene() takes.
const std::vector<std::string>& scene_kinds();

/// A world of about `solids` solids of the named kinds, at random places and angles in a box; some
/// of them hold one more. Their bounding spheres are disjoint. Volumes are called KIND_NUMBER.
/// Throws std::invalid_argument for an unknown kind.
///
/// Engines disagree on the rotation of a boolean's second solid: Geant4's reader and navjit turn
/// the solid by it, VecGeom 1.2.1 by its inverse. `inverse_booleans` writes the same scene for
/// VecGeom.
std::string random_scene(std::uint64_t seed, int solids, const std::vector<std::string>& kinds,
                         bool inverse_booleans = false);

}  // namespace navjit::campaign
