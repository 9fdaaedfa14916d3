// The daughters that a track may meet inside a daughter that it has just entered.
#pragma once

#include <vector>

#include "geometry/navigation/geometry.hpp"
#include "geometry/navigation/scene.hpp"

namespace navjit::codegen {

/// Whether the volume has daughters, and whether a track may be in one of them as soon as it enters
/// the volume.
kernels::InnerDaughters inner_of(const Geometry& geometry, VolumeId volume);
/// The same for each daughter of a scene. Thousands may be of one volume, which is examined once.
std::vector<kernels::InnerDaughters> inner_of_daughters(const Geometry& geometry,
                                                        const Scene& scene);

}  // namespace navjit::codegen
