// Boxes around the triangles of a mesh. Private to geometry/.
#pragma once

#include <span>
#include <vector>

#include "geometry/solids/facets.hpp"

namespace navjit::detail {

/// One hierarchy in two forms: boxes with two below each, and groups of eight boxes with the
/// corners of the triangles.
struct FacetHierarchy {
  std::vector<kernels::FacetBox<double>> boxes;
  std::vector<kernels::FacetGroup<double>> groups;
  std::vector<kernels::FacetLeaf<double>> leaves;
};

/// Brings the facets, of which there is at least one, into the order of the boxes. They are cut in
/// two again and again where the sum of (surface of the box) * (leaves for the facets within) is
/// least, the surface-area heuristic of ray tracing. Many facets are cut by the places of their
/// centres among 32 slabs along each axis (I. Wald, "On fast construction of SAH-based bounding
/// volume hierarchies", 2007). A group takes the cuts of its largest parts until its lanes are
/// full. O(n log n) where the cuts are even.
FacetHierarchy build_facet_hierarchy(std::span<const Vec3> corners,
                                     std::vector<kernels::Facet>& facets);

}  // namespace navjit::detail
