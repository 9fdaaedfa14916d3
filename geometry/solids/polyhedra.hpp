// Polyhedra about an axis.
#pragma once

#include "geometry/solids/polycone.hpp"

#include "geometry/kernels/polyhedra.h"

namespace navjit {

template <>
struct SolidFacts<kernels::Polyhedra<double>> {
  using Shape = kernels::Polyhedra<double>;

  static constexpr std::array kernel_files{"convex", "faces",    "wedge",    "tube",
                                           "cone",   "sections", "polycone", "polyhedra"};
  static double volume(const Shape& s);
  static Round round(const Shape& s);
};

template <>
inline constexpr const char* element_name<kernels::SideNormal<double>> = "SideNormal<double>";
template <>
inline constexpr const char* element_name<kernels::SideGroup<double>> = "SideGroup<double>";

}  // namespace navjit
