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
  static constexpr std::array elements{
      gdml::made_by<make_ellipsoid>(
          "ellipsoid", {gdml::length("ax"), gdml::length("by"), gdml::length("cz"),
                        gdml::length_or("zcut1", -1e6), gdml::length_or("zcut2", 1e6)}),
      // GDML gives half lengths here.
      gdml::made_by<make_eltube>("eltube",
                                 {gdml::length("dx"), gdml::length("dy"), gdml::length("dz")}),
      // dx and dy are slopes.
      gdml::made_by<make_elcone>("elcone", {gdml::number("dx"), gdml::number("dy"),
                                            gdml::length("zmax"), gdml::length("zcut")}),
      // GDML gives half of the length here.
      gdml::made_by<make_paraboloid>(
          "paraboloid", {gdml::length("rlo"), gdml::length("rhi"), gdml::length("dz")}),
      gdml::made_by<make_hype>("hype", {gdml::length("rmin", gdml::zero), gdml::length("rmax"),
                                        gdml::angle("inst", gdml::zero),
                                        gdml::angle("outst", gdml::zero), gdml::half("z")})};
};

namespace detail {
/// The volume within a quadric between two planes across z; its sections are ellipses.
double quadric_volume(const kernels::Quadric<double>& f, double low, double high);
}  // namespace detail

}  // namespace navjit
