// Polycones.
#pragma once

#include "geometry/solids/cone.hpp"

#include "geometry/kernels/sections.h"

#include "geometry/kernels/polycone.h"

namespace navjit {

template <>
struct SolidFacts<kernels::Polycone<double>> {
  using Shape = kernels::Polycone<double>;

  static constexpr std::array kernel_files{"convex", "wedge",    "tube",
                                           "cone",   "sections", "polycone"};
  static double volume(const Shape& s);
  static Round round(const Shape& s);
};

template <>
inline constexpr const char* element_name<kernels::Section<double>> = "Section<double>";
template <>
inline constexpr const char* element_name<kernels::Ledge<double>> = "Ledge<double>";

}  // namespace navjit
