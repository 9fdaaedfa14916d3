// Cones and segments of cones.
#pragma once

#include "geometry/solids/tube.hpp"

#include "geometry/kernels/cone.h"

namespace navjit {

template <>
struct SolidFacts<kernels::Cone<double>> {
  using Shape = kernels::Cone<double>;

  static constexpr std::array kernel_files{"convex", "wedge", "tube", "cone"};
  static double volume(const Shape& s);
  static Round round(const Shape& s);
};

}  // namespace navjit
