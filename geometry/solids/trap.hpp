// General trapezoids.
#pragma once

#include "geometry/solids/facts.hpp"

#include "geometry/kernels/trap.h"

namespace navjit {

template <>
struct SolidFacts<kernels::Trap<double>> {
  using Shape = kernels::Trap<double>;

  static constexpr std::array kernel_files{"convex", "faces", "trap"};
  static double volume(const Shape& s);
  static std::optional<double> error(const Shape& s, const KernelUse& use);
};

}  // namespace navjit
