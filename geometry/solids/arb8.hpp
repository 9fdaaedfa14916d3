// Solids of eight corners whose sides twist.
#pragma once

#include "geometry/solids/quadric.hpp"

#include "geometry/kernels/side_planes.h"

#include "geometry/kernels/arb8.h"

namespace navjit {

template <>
struct SolidFacts<kernels::Arb8<double>> {
  using Shape = kernels::Arb8<double>;

  static constexpr std::array kernel_files{"convex",  "faces",       "pairs",
                                           "quadric", "side_planes", "arb8"};
  static double volume(const Shape& s);
};

}  // namespace navjit
