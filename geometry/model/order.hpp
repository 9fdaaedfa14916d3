// The volumes of a tree in an order in which they can be worked on.
#pragma once

#include <vector>

#include "geometry/model/world.hpp"

namespace navjit {

/// The volumes of a finished world's tree, each after all its daughters.
std::vector<VolumeId> daughters_first(const World& world);

}  // namespace navjit
