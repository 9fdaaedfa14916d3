// Trapezoids with two pairs of faces that are alike.
#pragma once

#include "geometry/solids/facts.hpp"

#include "geometry/kernels/trd.h"

namespace navjit {

template <>
struct SolidFacts<kernels::Trd<double>> {
  using Shape = kernels::Trd<double>;

  static constexpr std::array kernel_files{"convex", "faces", "trd"};
  static double volume(const Shape& s);
  static std::optional<double> error(const Shape& s, const KernelUse& use);
};

}  // namespace navjit
