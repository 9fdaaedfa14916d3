// Optical photons: particles that fly from boundary to boundary, and are turned back at many of
// them.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/peers/flight.hpp"
#include "navjit/runtime.hpp"
#include "runtime/transport.hpp"

namespace navjit::bench {

struct PhotonOptions {
  double reflected = 0.5;  ///< of those that come to a boundary, 0 to 1
  int most_steps = 100;    ///< of a photon; then it is absorbed
  std::uint64_t seed = 1;
};

/// What the photons do, one after the other. Each starts somewhere along a ray, in any direction.
/// At a boundary it goes on with a slightly changed direction, or is reflected as by a mirror. As
/// in Geant4 it is in the volume behind the boundary by then, so that the next step leaves that at
/// once, with length 0.
std::vector<peers::Flight> photons(Runtime& runtime, const std::vector<Ray>& rays,
                                   const PhotonOptions& options);

}  // namespace navjit::bench
