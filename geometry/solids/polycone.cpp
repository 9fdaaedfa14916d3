#include "geometry/solids/sections.hpp"

namespace navjit {

Solid make_polycone(std::string name, std::span<const ZPlane> planes, double start_phi,
                    double delta_phi) {
  const kernels::Wedge<double> wedge = detail::make_wedge(start_phi, delta_phi, name);
  using Holder = detail::StackHolder<kernels::Polycone<double>>;
  const auto holder = std::make_shared<const Holder>(detail::make_sections(planes, name), wedge);
  const auto extent_of = [&](const ZPlane& plane) {
    return detail::sector_extent(plane.rmin, plane.rmax, start_phi, delta_phi, plane.z, plane.z);
  };
  Extent extent = extent_of(planes.front());
  for (const ZPlane& plane : planes) extent = detail::merged(extent, extent_of(plane));
  return {std::move(name), SolidKind::polycone, std::shared_ptr<const void>(holder, &holder->shape),
          extent};
}

}  // namespace navjit
