// A particle with its secondaries, as steps that any engine can repeat.
#pragma once

#include <vector>

namespace navjit::peers {

constexpr double no_limit = 1e30;   ///< mm
constexpr double no_length = 1e-9;  ///< mm: a step to a boundary that is no longer is repeated

/// One step: along the unit direction, to the next boundary but no further than the limit, mm.
struct FlightStep {
  double direction[3];
  double limit;
  bool secondary;  ///< a secondary starts where this ends; it is followed later, the last one first
  bool stops;      ///< the particle's last step; the last waiting secondary is next
};

/// A primary and all its secondaries. Once the particle of a step has left the world, the rest of
/// its steps is skipped.
struct Flight {
  double start[3];  ///< mm
  std::vector<FlightStep> steps;
};

}  // namespace navjit::peers
