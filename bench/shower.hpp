// A toy shower: particles that scatter as in matter.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/peers/flight.hpp"
#include "navjit/detector.hpp"
#include "navjit/runtime.hpp"
#include "runtime/transport.hpp"

namespace navjit::bench {

struct ShowerOptions {
  /// Mean length of a step in matter that is denser than a gas, mm. 0: a fifth of the material's
  /// radiation length, and no less than 0.01 mm.
  double mean_step = 0;
  /// Steps of a primary that do not end on a boundary; after so many it stops. Steps that end on a
  /// boundary count for a tenth.
  int most_steps = 100;
  std::uint64_t seed = 1;
};

/// The flights of the primaries, one after the other. In gases and vacuum (less than 0.01 g/cm3, or
/// no density) particles fly to the next boundary. Elsewhere a step has an exponential length; at
/// its end the direction changes by 0.1 rad on average, or one time in twenty to any other. In that
/// case a secondary starts there, too, with half of what the particle has left; it is followed once
/// its parent has stopped. Primaries that make no step have no flight: those that start outside the
/// world, and all of them if `most_steps` is not positive.
std::vector<peers::Flight> shower(Runtime& runtime, const std::vector<Ray>& primaries,
                                  const ShowerOptions& options);

}  // namespace navjit::bench
