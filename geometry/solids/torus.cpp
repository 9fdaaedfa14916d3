#include <algorithm>

#include "geometry/solids/make.hpp"

namespace navjit {

Solid make_torus(std::string name, double rmin, double rmax, double rtor, double start_phi,
                 double delta_phi) {
  detail::require_finite({rmin, rmax, rtor}, name);
  detail::require(rmin >= 0 && rmax > rmin, name, "a torus needs 0 <= rmin < rmax");
  detail::require(rtor > rmax, name, "a torus needs rmax < rtor");
  const kernels::Torus<double> shape{rmin, rmax, rtor,
                                     detail::make_wedge(start_phi, delta_phi, name)};
  return detail::make_solid(
      std::move(name), SolidKind::torus, shape,
      detail::sector_extent(rtor - rmax, rtor + rmax, start_phi, delta_phi, -rmax, rmax));
}

}  // namespace navjit
