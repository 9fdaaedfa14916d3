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
  /// Mean length of a step in what is denser than a gas, mm; 0: a fifth of the material's
  /// radiation length, and no less than 0.01 mm.
  double mean_step = 0;
  /// Steps of a primary that do not end on a boundary; then it has stopped. Those that do count
  /// for a tenth.
  int most_steps = 100;
  std::uint64_t seed = 1;
};

/// What the primaries do, one after the other. In gases and vacuum (less than 0.01 g/cm3, or no
/// density) particles fly to the next boundary. Elsewhere a step is of exponential length; at its
/// end the direction changes by 0.1 rad on average, one time in twenty to any other. There a
/// secondary starts, too, with half of what the particle has left; it is followed once its parent
/// has stopped.
std::vector<peers::Flight> shower(Runtime& runtime, const std::vector<Ray>& primaries,
                                  const ShowerOptions& options);

}  // namespace navjit::bench
