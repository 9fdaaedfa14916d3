// Twisted boxes, trds and traps.
#pragma once

#include "geometry/solids/facts.hpp"

#include "geometry/kernels/twisted_trap.h"

namespace navjit {

template <>
struct SolidFacts<kernels::TwistedTrap<double>> {
  using Shape = kernels::TwistedTrap<double>;

  static constexpr std::array kernel_files{"convex", "pairs", "twisted_trap"};
  static double volume(const Shape& s);
  static constexpr std::array elements{
      gdml::made_by<make_twistedbox>("twistedbox", {gdml::angle("PhiTwist"), gdml::half("x"),
                                                    gdml::half("y"), gdml::half("z")}),
      gdml::made_by<make_twistedtrd>(
          "twistedtrd", {gdml::half("x1"), gdml::half("x2"), gdml::half("y1"), gdml::half("y2"),
                         gdml::half("z"), gdml::angle("PhiTwist")})};
};

}  // namespace navjit
