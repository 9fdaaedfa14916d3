// Random worlds of rotated solids that touch nothing, as GDML that any engine can read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace navjit::campaign {

/// The kinds of solids, by their names in random_scene.
const std::vector<std::string>& scene_kinds();

/// A world of about `solids` solids of the kinds named, at random places and angles in a box; some
/// of them hold one more. Their bounding spheres are disjoint. Volumes are called KIND_NUMBER.
/// Throws std::invalid_argument for a kind that is not known.
///
/// Engines disagree on the rotation of a boolean's second solid: Geant4's reader, and ours, turn
/// the solid by it, VecGeom 1.2.1 by its inverse. `inverse_booleans` writes the same scene for the
/// latter.
std::string random_scene(std::uint64_t seed, int solids, const std::vector<std::string>& kinds,
                         bool inverse_booleans = false);

}  // namespace navjit::campaign
