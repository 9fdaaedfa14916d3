// An order of the volumes of a tree in which each comes after its daughters.
#pragma once

#include <vector>

#include "geometry/model/world.hpp"

namespace navjit {

/// The volumes of a finished world's tree, each after all its daughters.
std::vector<VolumeId> daughters_first(const World& world);

}  // namespace navjit
