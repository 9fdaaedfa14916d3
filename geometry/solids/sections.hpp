// Cuts the contour of a polycone or polyhedra into rings. Private to geometry/solids.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/solids/make.hpp"

namespace navjit::detail {

struct Sections {
  std::vector<kernels::Section<double>> sections;  ///< with ascending z
  std::vector<kernels::Ledge<double>> ledges;
  double rmax;
};

/// Cuts the contour at the z of every plane. Throws GeometryError if the contour crosses itself or
/// encloses nothing.
Sections make_sections(std::span<const ZPlane> planes, const std::string& name);
/// The same for a closed contour.
Sections make_sections(std::span<const ContourPoint> contour, const std::string& name);

/// A shape made of sections, with the arrays that it points to.
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

/// `area_factor`: the area of a section whose squared radius is 1; the volume is in mm^3.
template <class Shape>
double sections_volume(const Shape& s, double area_factor) {
  double integral = 0;
  for (int i = 0; i < s.count; ++i) {
    const auto& section = s.sections[i];
    const double length = section.z_high - section.z_low;
    integral += squared_radius_integral(section.outer, 0, length);
    if (section.bored != 0) integral -= squared_radius_integral(section.inner, 0, length);
  }
  return area_factor * integral;
}

template <class Shape>
Round round_sections(const Shape& s) {
  Round round{s.rmax, s.rmax, s.wedge};
  for (int i = 0; i < s.count; ++i) {
    const auto& section = s.sections[i];
    const double height = section.z_high - section.z_low;
    if (section.bored == 0) {
      round.near = 0;
    } else {
      round.near = std::min(
          {round.near, radius_at(section.inner, 0, 0), radius_at(section.inner, height, 0)});
    }
  }
  round.near = std::max(round.near, 0.0);
  return round;
}

}  // namespace navjit::detail
