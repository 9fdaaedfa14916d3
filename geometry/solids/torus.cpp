#include <algorithm>

#include "geometry/solids/make.hpp"

namespace navjit {

Solid make_torus(std::string name, double rmin, double rmax, double rtor, double start_phi,
                 double delta_phi) {
  detail::require_finite({rmin, rmax, rtor}, name);
  detail::require(rmin >= 0 && rmax > rmin, name, "a torus needs 0 <= rmin < rmax");
  detail::require(rtor > 0, name, "a torus needs rtor > 0");
  const kernels::Torus<double> shape{rmin, rmax, rtor,
                                     detail::make_wedge(start_phi, delta_phi, name)};
  return detail::make_solid(std::move(name), SolidKind::torus, shape,
                            detail::sector_extent(std::max(rtor - rmax, 0.0), rtor + rmax,
                                                  start_phi, delta_phi, -rmax, rmax));
}

}  // namespace navjit
