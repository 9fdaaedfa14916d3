// States in one volume, for measurements of one scene.
#pragma once

#include <cstdint>
#include <vector>

#include "navjit/runtime.hpp"
#include "runtime/transport.hpp"

namespace navjit::bench {

/// A ray, and the touchable of the volume that it starts in.
struct SceneRay {
  Ray ray;
  State state;
};

/// Up to `count` rays that start in `volume` itself and not in a daughter. Their points are uniform
/// in its solid, in a random one of a few touchables; their directions are isotropic. There are
/// fewer if the volume is hard to hit.
std::vector<SceneRay> rays_in_volume(Runtime& runtime, VolumeId volume, std::size_t count,
                                     std::uint64_t seed);

}  // namespace navjit::bench
