// Twisted tube segments.
#pragma once

#include "geometry/solids/quadric.hpp"

#include "geometry/kernels/twisted_tube.h"

namespace navjit {

template <>
struct SolidFacts<kernels::TwistedTube<double>> {
  using Shape = kernels::TwistedTube<double>;

  static constexpr std::array kernel_files{"convex", "pairs", "quadric", "twisted_tube"};
  static double volume(const Shape& s);
};

}  // namespace navjit
