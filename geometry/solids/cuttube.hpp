// Tubes with oblique ends.
#pragma once

#include "geometry/solids/trap.hpp"
#include "geometry/solids/tube.hpp"

#include "geometry/kernels/cuttube.h"

namespace navjit {

template <>
struct SolidFacts<kernels::CutTube<double>> {
  using Shape = kernels::CutTube<double>;

  static constexpr std::array kernel_files{"convex", "faces", "trap", "wedge", "tube", "cuttube"};
  static double volume(const Shape& s);
  static Round round(const Shape& s);
};

}  // namespace navjit
