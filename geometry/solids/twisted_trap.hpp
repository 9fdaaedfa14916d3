// Twisted boxes, trds and traps.
#pragma once

#include "geometry/solids/facts.hpp"

#include "geometry/kernels/twisted_trap.h"

namespace navjit {

template <>
struct SolidFacts<kernels::TwistedTrap<double>> {
  using Shape = kernels::TwistedTrap<double>;

  static constexpr std::array kernel_files{"convex", "pairs", "twisted_trap"};
  static double volume(const Shape& s);
};

}  // namespace navjit
