#include <algorithm>

#include "geometry/solids/make.hpp"

namespace navjit {
namespace {

/// The face through r1 at -hz and r2 at +hz; z counts from the centre.
kernels::ConicalFace<double> centred_face(double r1, double r2, double hz) {
  kernels::ConicalFace<double> face = detail::conical_face(r1, r2, 2 * hz);
  face.radius = face.cosine * ((r1 + r2) / 2);
  return face;
}

}  // namespace

Solid make_cone(std::string name, double rmin1, double rmax1, double rmin2, double rmax2, double hz,
                double start_phi, double delta_phi) {
  detail::require_finite({rmin1, rmax1, rmin2, rmax2, hz}, name);
  detail::require(rmin1 >= 0 && rmin2 >= 0, name, "a cone needs radii that are not negative");
  detail::require(rmax1 >= rmin1 && rmax2 >= rmin2, name, "a cone needs rmin <= rmax at both ends");
  detail::require(rmax1 > rmin1 || rmax2 > rmin2, name, "a cone needs rmin < rmax at one end");
  detail::require(hz > 0, name, "a cone needs a positive length");
  if (rmin1 == rmin2 && rmax1 == rmax2) {
    return make_tube(std::move(name), rmin1, rmax1, hz, start_phi, delta_phi);
  }
  const kernels::Cone<double> shape{hz, centred_face(rmax1, rmax2, hz),
                                    centred_face(rmin1, rmin2, hz), rmin1 > 0 || rmin2 > 0 ? 1 : 0,
                                    detail::make_wedge(start_phi, delta_phi, name)};
  const Extent extent = merged(detail::sector_extent(rmin1, rmax1, start_phi, delta_phi, -hz, hz),
                               detail::sector_extent(rmin2, rmax2, start_phi, delta_phi, -hz, hz));
  return detail::make_solid(std::move(name), SolidKind::cone, shape, extent);
}

double SolidFacts<kernels::Cone<double>>::volume(const Shape& s) {
  double integral = detail::squared_radius_integral(s.outer, -s.hz, s.hz);
  if (s.bored != 0) integral -= detail::squared_radius_integral(s.inner, -s.hz, s.hz);
  return detail::angle_of(s.wedge) / 2 * integral;
}

Round SolidFacts<kernels::Cone<double>>::round(const Shape& s) {
  using detail::radius_at;
  return {s.bored == 0
              ? 0.0
              : std::max(0.0, std::min(radius_at(s.inner, -s.hz, 0), radius_at(s.inner, s.hz, 0))),
          std::max(radius_at(s.outer, -s.hz, INFINITY), radius_at(s.outer, s.hz, INFINITY)),
          s.wedge};
}

}  // namespace navjit
