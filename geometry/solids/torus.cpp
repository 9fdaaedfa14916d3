#include <algorithm>
#include <numbers>

#include "geometry/solids/make.hpp"

namespace navjit {
namespace {

/// The integral of the distance from the axis over a disc around radius `ring`, without the part of
/// the disc beyond the axis.
double disc_moment(double ring, double r) {
  if (r <= ring) return ring * (std::numbers::pi * r * r);
  const double cut = std::sqrt((r - ring) * (r + ring));
  return ring * (r * r * (std::numbers::pi / 2 + std::asin(ring / r)) + ring * cut) +
         cut * cut * cut * 2 / 3;
}

}  // namespace

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

double SolidFacts<kernels::Torus<double>>::volume(const Shape& s) {
  if (s.rmax <= s.rtor) {
    return detail::angle_of(s.wedge) * s.rtor *
           (std::numbers::pi * (s.rmax - s.rmin) * (s.rmax + s.rmin));
  }
  return detail::angle_of(s.wedge) * (disc_moment(s.rtor, s.rmax) - disc_moment(s.rtor, s.rmin));
}

}  // namespace navjit
