// Balls.
#pragma once

#include "geometry/solids/cone.hpp"

#include "geometry/kernels/orb.h"

namespace navjit {

template <>
struct SolidFacts<kernels::Orb<double>> {
  using Shape = kernels::Orb<double>;

  static constexpr std::array kernel_files{"convex", "wedge", "tube", "cone", "orb"};
  static double volume(const Shape& s);
  static double ball(const Shape& s);
  static std::optional<double> error(const Shape& s, const KernelUse& use);
  static constexpr std::array elements{gdml::made_by<make_orb>("orb", {gdml::length("r")})};
};

}  // namespace navjit
