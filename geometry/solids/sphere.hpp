// Spherical shells and segments of them.
#pragma once

#include "geometry/solids/orb.hpp"

#include "geometry/kernels/sphere.h"

namespace navjit {

template <>
struct SolidFacts<kernels::Sphere<double>> {
  using Shape = kernels::Sphere<double>;

  static constexpr std::array kernel_files{"convex", "wedge", "tube", "cone", "orb", "sphere"};
  static double volume(const Shape& s);
  static Round round(const Shape& s);
  static double ball(const Shape& s);
  static std::optional<double> error(const Shape& s, const KernelUse& use);
  static constexpr std::array elements{gdml::made_by<make_sphere>(
      "sphere",
      {gdml::length("rmin", gdml::zero), gdml::length("rmax"), gdml::angle("startphi", gdml::zero),
       gdml::angle("deltaphi"), gdml::angle("starttheta", gdml::zero), gdml::angle("deltatheta")})};
};

}  // namespace navjit
