// What a track may meet inside a daughter that it has just entered.
#pragma once

#include <vector>

#include "geometry/navigation/geometry.hpp"
#include "geometry/navigation/scene.hpp"

namespace navjit::codegen {

/// What a volume has of its own where a track enters it.
kernels::InnerDaughters inner_of(const Geometry& geometry, VolumeId volume);
/// The same by daughter of a scene. Thousands may be of one volume, which is looked at once.
std::vector<kernels::InnerDaughters> inner_of_daughters(const Geometry& geometry,
                                                        const Scene& scene);

}  // namespace navjit::codegen
