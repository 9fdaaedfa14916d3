// Steps of particles, recorded once and repeated by every engine, so that all engines answer the
// same questions without drawing random numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/peers/flight.hpp"
#include "navjit/navigator.hpp"

namespace navjit::bench {

/// Makes a step and those of no length before it: engines differ in how many they make on a
/// boundary. `state` and `point` (mm, global) say where it begins, and afterwards where it ends.
Step moved(Navigator& navigator, State& state, Vec3& point, const Vec3& direction, double limit);

/// What an engine did with flights.
struct Followed {
  std::uint64_t steps = 0;
  double length = 0;    ///< mm
  double safeties = 0;  ///< their sum, mm
};

/// Which safeties are asked for.
enum class Asked : std::uint8_t {
  none,
  enough,  ///< no more than the length of the planned step
  whole,
};

/// Repeats the flights with a navigator. Asks for the safety, if wanted, before each step that does
/// not start on a boundary: there it is 0, and multiple scattering does not ask.
Followed follow(Navigator& navigator, const std::vector<peers::Flight>& flights, Asked asked);

}  // namespace navjit::bench
