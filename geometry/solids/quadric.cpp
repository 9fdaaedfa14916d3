// Ellipsoids, elliptical tubes and cones, paraboloids and hyperbolic tubes.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/solids/make.hpp"

namespace navjit {
namespace {

using kernels::Quadric;
using QuadricShape = kernels::QuadricSolid<double>;

Extent extent_of(const QuadricShape& s) {
  return {{-s.hx, -s.hy, s.z_low}, {s.hx, s.hy, s.z_high}};
}

/// The solid, unless squares of its lengths are too small or too large for their reciprocals: then
/// its equation would hold everything, or nothing.
Solid made_of(std::string name, SolidKind kind, const QuadricShape& shape, const Extent& extent) {
  for (const Quadric<double>* face : {&shape.outer, &shape.inner}) {
    for (const double x : {face->a, face->b, face->c, face->d, face->e}) {
      detail::require(std::isfinite(x), name, "its lengths are too small or too large");
    }
  }
  detail::require(shape.outer.a > 0 && shape.outer.b > 0, name,
                  "its lengths are too small or too large");
  return detail::make_solid(std::move(name), kind, shape, extent);
}

double tangent_squared(double angle) {
  const double tangent = std::tan(angle);
  return tangent * tangent;
}

}  // namespace

Solid make_ellipsoid(std::string name, double ax, double by, double cz, double z_cut1,
                     double z_cut2) {
  detail::require_finite({ax, by, cz, z_cut1, z_cut2}, name);
  detail::require(ax > 0 && by > 0 && cz > 0, name, "an ellipsoid needs positive semi-axes");
  if (z_cut1 == 0 && z_cut2 == 0) z_cut1 = -cz, z_cut2 = cz;
  detail::require(z_cut1 < z_cut2 && z_cut1 < cz && z_cut2 > -cz, name,
                  "the cuts of an ellipsoid leave nothing");
  const double low = std::max(z_cut1, -cz), high = std::min(z_cut2, cz);
  const double narrowest = low > 0 ? low / cz : high < 0 ? high / cz : 0;
  const double widest = std::sqrt(1 - narrowest * narrowest);
  // Planes that do not cut are kept away from the poles.
  const double clear = 1.0625 * cz;
  const QuadricShape shape{ax * widest,
                           by * widest,
                           low > -cz ? low : -clear,
                           high < cz ? high : clear,
                           {1 / (ax * ax), 1 / (by * by), 1 / (cz * cz), 0, -1, 0},
                           {},
                           0};
  Extent extent = extent_of(shape);
  extent.min.z = low;
  extent.max.z = high;
  return made_of(std::move(name), SolidKind::ellipsoid, shape, extent);
}

Solid make_eltube(std::string name, double hx, double hy, double hz) {
  detail::require_finite({hx, hy, hz}, name);
  detail::require(hx > 0 && hy > 0 && hz > 0, name, "an elliptical tube needs positive lengths");
  const QuadricShape shape{hx, hy, -hz, hz, {1 / (hx * hx), 1 / (hy * hy), 0, 0, -1, 0}, {}, 0};
  return made_of(std::move(name), SolidKind::eltube, shape, extent_of(shape));
}

Solid make_elcone(std::string name, double x_slope, double y_slope, double z_max, double z_cut) {
  detail::require_finite({x_slope, y_slope, z_max, z_cut}, name);
  detail::require(x_slope > 0 && y_slope > 0 && z_max > 0, name,
                  "an elliptical cone needs positive semi-axes and a positive height");
  detail::require(z_cut > 0, name, "an elliptical cone needs a positive cut");
  const double hz = std::min(z_cut, z_max), height = z_max + hz;
  const QuadricShape shape{x_slope * height,
                           y_slope * height,
                           -hz,
                           hz,
                           {1 / (x_slope * x_slope), 1 / (y_slope * y_slope), -1, 0, 0, z_max},
                           {},
                           0};
  return made_of(std::move(name), SolidKind::elcone, shape, extent_of(shape));
}

Solid make_paraboloid(std::string name, double r_low, double r_high, double hz) {
  detail::require_finite({r_low, r_high, hz}, name);
  detail::require(r_low >= 0 && r_high > r_low, name,
                  "a paraboloid needs 0 <= its lower radius < its upper radius");
  detail::require(hz > 0, name, "a paraboloid needs a positive length");
  const double rise = (r_high - r_low) * (r_high + r_low) / (2 * hz);
  const QuadricShape shape{r_high, r_high, -hz, hz, {1, 1, 0, -rise, -r_low * r_low, -hz}, {}, 0};
  return made_of(std::move(name), SolidKind::paraboloid, shape, extent_of(shape));
}

Solid make_hype(std::string name, double rmin, double rmax, double inner_stereo,
                double outer_stereo, double hz) {
  detail::require_finite({rmin, rmax, inner_stereo, outer_stereo, hz}, name);
  detail::require(hz > 0, name, "a hyperbolic tube needs a positive length");
  detail::require(rmin >= 0 && rmax > rmin, name, "a hyperbolic tube needs 0 <= rmin < rmax");
  const double inner = tangent_squared(inner_stereo), outer = tangent_squared(outer_stereo);
  const double end_inner = rmin * rmin + inner * hz * hz, end_outer = rmax * rmax + outer * hz * hz;
  detail::require(std::isfinite(end_outer) && end_inner <= end_outer, name,
                  "the inner face of a hyperbolic tube ends outside of the outer one");
  const double reach = std::sqrt(end_outer);
  const bool bored = end_inner > 0;
  const QuadricShape shape{
      reach,
      reach,
      -hz,
      hz,
      {1, 1, -outer, 0, -rmax * rmax, 0},
      bored ? Quadric<double>{1, 1, -inner, 0, -rmin * rmin, 0} : Quadric<double>{},
      bored ? 1 : 0};
  return made_of(std::move(name), SolidKind::hype, shape, extent_of(shape));
}

double detail::quadric_volume(const kernels::Quadric<double>& f, double low, double high) {
  if (f.c > 0) {
    const double reach = std::sqrt(-f.e / f.c);
    low = std::max(low, -reach);
    high = std::min(high, reach);
  }
  const auto primitive = [&](double z) { return z * (f.e + z * (f.d / 2 + z * (f.c / 3))); };
  return std::numbers::pi / std::sqrt(f.a * f.b) *
         (primitive(low - f.origin) - primitive(high - f.origin));
}

double SolidFacts<kernels::QuadricSolid<double>>::volume(const Shape& s) {
  const double outer = detail::quadric_volume(s.outer, s.z_low, s.z_high);
  return s.bored == 0 ? outer : outer - detail::quadric_volume(s.inner, s.z_low, s.z_high);
}

}  // namespace navjit
