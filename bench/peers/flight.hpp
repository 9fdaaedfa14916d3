// A particle with its secondaries, as steps that any engine can make again.
#pragma once

#include <vector>

namespace navjit::peers {

constexpr double no_limit = 1e30;   ///< mm
constexpr double no_length = 1e-9;  ///< mm: a step to a boundary that is no longer is made again

/// One step: along the unit direction, to the next boundary but no further than the limit, mm.
struct FlightStep {
  double direction[3];
  double limit;
  bool secondary;  ///< one starts where this ends, and is followed later: the last one first
  bool stops;      ///< the particle's last step: on with the last secondary that waits
};

/// A primary and all that comes of it. Where a step's particle has left the world, what is left of
/// its steps is passed over.
struct Flight {
  double start[3];  ///< mm
  std::vector<FlightStep> steps;
};

}  // namespace navjit::peers
