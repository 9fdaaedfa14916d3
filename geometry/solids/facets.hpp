// Bodies within triangles: tessellated and extruded solids.
#pragma once

#include "geometry/solids/facts.hpp"

// clang-format off
#include "geometry/kernels/facet_leaves.h"
#include "geometry/kernels/facet_groups.h"
#include "geometry/kernels/facet_mesh.h"
#include "geometry/kernels/facet_distances.h"
#include "geometry/kernels/facets.h"
// clang-format on

namespace navjit {

template <>
struct SolidFacts<kernels::Facets<double>> {
  using Shape = kernels::Facets<double>;

  static constexpr std::array kernel_files{"convex",     "facet_leaves",    "facet_groups",
                                           "facet_mesh", "facet_distances", "facets"};
  /// The volume; negative if the triangles face inwards.
  static double volume(const Shape& s);
};

/// Whether triangles with this volume, mm3, which may be negative, enclose more than this part of
/// their area times their size, mm. That product measures what flat facets seem to enclose by
/// rounding; the third power of the size would not: a thin wire encloses far less of it.
bool enclose_more(const kernels::Facets<double>& s, double volume, double size, double part);

template <>
inline constexpr const char* element_name<kernels::Vec3<double>> = "Vec3<double>";
template <>
inline constexpr const char* element_name<kernels::Facet> = "Facet";
template <>
inline constexpr const char* element_name<kernels::FacetBox<double>> = "FacetBox<double>";
template <>
inline constexpr const char* element_name<kernels::FacetGroup<double>> = "FacetGroup<double>";
template <>
inline constexpr const char* element_name<kernels::FacetLeaf<double>> = "FacetLeaf<double>";

}  // namespace navjit
