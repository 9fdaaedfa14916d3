// Volumes that are scenes of the same structure, so that one navigator serves them all.
#pragma once

#include <vector>

#include "analysis/facts.hpp"

namespace navjit {

/// By volume: the lowest-numbered volume whose scene has the same solid, the same daughters at the
/// same places, the same mother, and frames of the same kind. Volumes outside the tree are alone.
std::vector<VolumeId> equal_scenes(const Geometry& geometry, const WorldFacts& facts);

}  // namespace navjit
