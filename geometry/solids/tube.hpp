// Tubes and segments of tubes.
#pragma once

#include "geometry/solids/facts.hpp"

#include "geometry/kernels/tube.h"

namespace navjit {

template <>
struct SolidFacts<kernels::Tube<double>> {
  using Shape = kernels::Tube<double>;

  static constexpr std::array kernel_files{"convex", "wedge", "tube"};
  static double volume(const Shape& s);
  static Round round(const Shape& s);
  static std::optional<double> error(const Shape& s, const KernelUse& use);
};

}  // namespace navjit
