// Boxes.
#pragma once

#include "geometry/solids/facts.hpp"

#include "geometry/kernels/box.h"

namespace navjit {

template <>
struct SolidFacts<kernels::Box<double>> {
  using Shape = kernels::Box<double>;

  static constexpr std::array kernel_files{"convex", "box"};
  static double volume(const Shape& s);
  static std::optional<double> error(const Shape& s, const KernelUse& use);
};

}  // namespace navjit
