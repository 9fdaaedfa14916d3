// Upright prisms: extruded solids of one section.
#pragma once

#include "geometry/solids/facts.hpp"

#include "geometry/kernels/prism.h"

namespace navjit {

template <>
struct SolidFacts<kernels::Prism<double>> {
  using Shape = kernels::Prism<double>;

  static constexpr std::array kernel_files{"convex", "pairs", "prism"};
  static double volume(const Shape& s);
};

template <>
inline constexpr const char* element_name<kernels::PlanarCorner<double>> = "PlanarCorner<double>";
template <>
inline constexpr const char* element_name<kernels::CornerGroup<double>> = "CornerGroup<double>";

}  // namespace navjit
