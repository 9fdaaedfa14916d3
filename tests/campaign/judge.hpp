// Transports rays and compares each with the detector itself, computed with 113 bits.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/reference/wide_geometry.hpp"
#include "navjit/navigator.hpp"
#include "runtime/transport.hpp"

namespace navjit::campaign {

struct Counts {
  std::uint64_t rays = 0;
  std::uint64_t outside = 0;  ///< of the rays: started outside the world, and made no step
  std::uint64_t steps = 0;
  std::uint64_t zero_steps = 0;  ///< of the steps: no longer than the tolerance
  std::uint64_t stuck = 0;       ///< rays
  std::uint64_t lost = 0;        ///< rays that did not end where the world does
  std::uint64_t checked = 0;     ///< steps of which points were judged
  std::uint64_t unsafe = 0;      ///< points whose safety exceeds the way to the end of the step
  std::array<std::uint64_t, 6> points{};  ///< judged, by reference::Verdict

  Counts& operator+=(const Counts& other);
  std::uint64_t judged() const;
  std::uint64_t wrong() const;
  std::uint64_t defects() const { return stuck + lost + wrong() + unsafe; }
};

/// A defect, with what is needed to repeat it.
struct Defect {
  std::string what;
  Ray ray;
  std::uint64_t index;  ///< of the ray
  std::uint64_t step;
  std::string path;  ///< of the touchable
  double from;       ///< length of the ray before the step, mm
  double length;     ///< of the step, mm
};

struct Plan {
  std::uint64_t seed = 1;
  double checked = 0.05;          ///< share of the steps whose points are judged
  std::size_t most_defects = 20;  ///< kept in detail
};

/// Transports ray number `index` and adds its result.
void run_ray(Navigator& navigator, const reference::WideGeometry& reference, const Plan& plan,
             std::uint64_t index, Counts& counts, std::vector<Defect>& defects);

}  // namespace navjit::campaign
