// The contour of a polycone or polyhedra, cut into rings. Private to geometry/solids.
#pragma once

#include <vector>

#include "geometry/solids/make.hpp"

namespace navjit::detail {

struct Sections {
  std::vector<kernels::Section<double>> sections;  ///< ascending in z
  std::vector<kernels::Ledge<double>> ledges;
  double rmax;
};

/// Cuts the contour at every z of a plane. Throws GeometryError if it crosses itself or encloses
/// nothing.
Sections make_sections(std::span<const ZPlane> planes, const std::string& name);
/// The same for a closed contour.
Sections make_sections(std::span<const ContourPoint> contour, const std::string& name);

/// A shape made of sections with the arrays that it points to.
template <class Shape>
struct SectionsHolder {
  Sections sections;
  Shape shape;

  SectionsHolder(Sections&& made, const kernels::Wedge<double>& wedge)
      : sections(std::move(made)), shape{} {
    shape.sections = sections.sections.data();
    shape.count = static_cast<int>(sections.sections.size());
    shape.ledges = sections.ledges.data();
    shape.ledge_count = static_cast<int>(sections.ledges.size());
    shape.z_low = sections.sections.front().z_low;
    shape.z_high = sections.sections.back().z_high;
    shape.rmax = sections.rmax;
    shape.wedge = wedge;
  }
  SectionsHolder(const SectionsHolder&) = delete;
  SectionsHolder& operator=(const SectionsHolder&) = delete;
};

}  // namespace navjit::detail
