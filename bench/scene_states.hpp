// States in one volume, for measurements of one scene.
#pragma once

#include <cstdint>
#include <vector>

#include "navjit/runtime.hpp"
#include "runtime/transport.hpp"

namespace navjit::bench {

/// A ray, and the touchable of the volume in which it starts.
struct SceneRay {
  Ray ray;
  State state;
};

/// Up to `count` rays that start in `volume` itself, not in a daughter: points uniform in its
/// solid, in a touchable taken at random among a few, directions isotropic. Fewer where the volume
/// is hard to hit.
std::vector<SceneRay> rays_in_volume(Runtime& runtime, VolumeId volume, std::size_t count,
                                     std::uint64_t seed);

}  // namespace navjit::bench
