#include "geometry/solids/sections.hpp"

namespace navjit {

namespace {

/// `planes` give the extent.
Solid polycone(std::string name, detail::Sections&& sections, std::span<const ZPlane> planes,
               double start_phi, double delta_phi) {
  const kernels::Wedge<double> wedge = detail::make_wedge(start_phi, delta_phi, name);
  using Holder = detail::SectionsHolder<kernels::Polycone<double>>;
  const auto holder = std::make_shared<const Holder>(std::move(sections), wedge);
  const auto extent_of = [&](const ZPlane& plane) {
    return detail::sector_extent(plane.rmin, plane.rmax, start_phi, delta_phi, plane.z, plane.z);
  };
  Extent extent = extent_of(planes.front());
  for (const ZPlane& plane : planes) extent = merged(extent, extent_of(plane));
  return {std::move(name), SolidKind::polycone, std::shared_ptr<const void>(holder, &holder->shape),
          extent};
}

}  // namespace

Solid make_polycone(std::string name, std::span<const ZPlane> planes, double start_phi,
                    double delta_phi) {
  detail::Sections sections = detail::make_sections(planes, name);
  if (planes.size() == 2 && planes[0].z == -planes[1].z) {
    const ZPlane &low = planes[planes[0].z < 0 ? 0 : 1], &high = planes[planes[0].z < 0 ? 1 : 0];
    return make_cone(std::move(name), low.rmin, low.rmax, high.rmin, high.rmax, high.z, start_phi,
                     delta_phi);
  }
  return polycone(std::move(name), std::move(sections), planes, start_phi, delta_phi);
}

Solid make_generic_polycone(std::string name, std::span<const ContourPoint> contour,
                            double start_phi, double delta_phi) {
  detail::Sections sections = detail::make_sections(contour, name);
  std::vector<ZPlane> planes;
  for (const ContourPoint& p : contour) planes.push_back({p.z, p.r, p.r});
  return polycone(std::move(name), std::move(sections), planes, start_phi, delta_phi);
}

double SolidFacts<kernels::Polycone<double>>::volume(const Shape& s) {
  return detail::sections_volume(s, detail::angle_of(s.wedge) / 2);
}

Round SolidFacts<kernels::Polycone<double>>::round(const Shape& s) {
  return detail::round_sections(s);
}

}  // namespace navjit
