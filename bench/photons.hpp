// Optical photons: particles that fly from boundary to boundary, and are reflected at many of
// them.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/peers/flight.hpp"
#include "navjit/runtime.hpp"
#include "runtime/transport.hpp"

namespace navjit::bench {

struct PhotonOptions {
  double reflected = 0.5;  ///< fraction of those that come to a boundary
  int most_steps = 100;    ///< of a photon, which then is absorbed
  std::uint64_t seed = 1;
};

/// The flights of the photons, one after the other. Each starts somewhere along a ray, in any
/// direction. At a boundary it goes on with a slightly changed direction, or is reflected as by a
/// mirror. As in Geant4, it is then in the volume behind the boundary, so that the next step leaves
/// that volume at once, with length 0. Photons that make no step have no flight: those that start
/// outside the world, and all of them if `most_steps` is not positive.
std::vector<peers::Flight> photons(Runtime& runtime, const std::vector<Ray>& rays,
                                   const PhotonOptions& options);

}  // namespace navjit::bench
