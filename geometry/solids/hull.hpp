// Convex bodies behind planes: tetrahedra, convex extruded solids.
#pragma once

#include "geometry/solids/trap.hpp"

#include "geometry/kernels/hull.h"

namespace navjit {

template <>
struct SolidFacts<kernels::Hull<double>> {
  using Shape = kernels::Hull<double>;

  static constexpr std::array kernel_files{"convex", "faces", "trap", "hull"};
  static double volume(const Shape& s);
  static std::optional<double> error(const Shape& s, const KernelUse& use);
};

template <>
inline constexpr const char* element_name<kernels::Plane<double>> = "Plane<double>";
template <>
inline constexpr const char* element_name<kernels::PlaneGroup<double>> = "PlaneGroup<double>";

}  // namespace navjit
