// Tori and segments of tori.
#pragma once

#include "geometry/solids/facts.hpp"

#include "geometry/kernels/torus.h"

namespace navjit {

template <>
struct SolidFacts<kernels::Torus<double>> {
  using Shape = kernels::Torus<double>;

  static constexpr std::array kernel_files{"convex", "wedge", "pairs", "torus"};
  static double volume(const Shape& s);
};

}  // namespace navjit
