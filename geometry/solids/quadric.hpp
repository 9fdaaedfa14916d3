// Ellipsoids, elliptical tubes and cones, paraboloids and hyperbolic tubes.
#pragma once

#include "geometry/solids/facts.hpp"

#include "geometry/kernels/quadric.h"

namespace navjit {

template <>
struct SolidFacts<kernels::QuadricSolid<double>> {
  using Shape = kernels::QuadricSolid<double>;

  static constexpr std::array kernel_files{"convex", "pairs", "quadric"};
  static double volume(const Shape& s);
};

namespace detail {
/// Volume within a quadric between two planes across z; its sections are ellipses.
double quadric_volume(const kernels::Quadric<double>& f, double low, double high);
}  // namespace detail

}  // namespace navjit
