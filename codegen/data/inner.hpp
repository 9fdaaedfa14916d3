// What a track may meet inside a daughter that it has just entered.
#pragma once

#include "geometry/navigation/geometry.hpp"
#include "geometry/navigation/scene.hpp"

namespace navjit::codegen {

/// What a volume has of its own where a track enters it.
kernels::InnerDaughters inner_of(const Geometry& geometry, VolumeId volume);

}  // namespace navjit::codegen
