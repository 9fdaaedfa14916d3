#include <algorithm>
#include <optional>

#include "geometry/solids/make.hpp"

namespace navjit {

Solid make_tube(std::string name, double rmin, double rmax, double hz, double start_phi,
                double delta_phi) {
  detail::require_finite({rmin, rmax, hz}, name);
  detail::require(rmin >= 0 && rmax > rmin, name, "a tube needs 0 <= rmin < rmax");
  detail::require(hz > 0, name, "a tube needs a positive length");
  const kernels::Tube<double> shape{rmin, rmax, hz, detail::make_wedge(start_phi, delta_phi, name)};
  return detail::make_solid(std::move(name), SolidKind::tube, shape,
                            detail::sector_extent(rmin, rmax, start_phi, delta_phi, -hz, hz));
}

double SolidFacts<kernels::Tube<double>>::volume(const Shape& s) {
  return detail::angle_of(s.wedge) * (s.rmax - s.rmin) * (s.rmax + s.rmin) * s.hz;
}

Round SolidFacts<kernels::Tube<double>>::round(const Shape& s) { return {s.rmin, s.rmax, s.wedge}; }

std::optional<double> SolidFacts<kernels::Tube<double>>::error(const Shape& s,
                                                               const KernelUse& use) {
  return std::max({face_error::slab(s.hz, use), face_error::cylinder(s.rmax, use),
                   face_error::cylinder(s.rmin, use), face_error::wedge(s.wedge, use)});
}

}  // namespace navjit
