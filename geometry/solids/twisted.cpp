// Twisted tube segments, boxes, trds and traps.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "geometry/solids/make.hpp"

namespace navjit {
namespace {

constexpr double pi = std::numbers::pi;

/// A side through (offset0 + offset1 z) along its normal (nu, nw), whose length need not be 1.
kernels::TwistedSide<double> side(double nu, double nw, double offset0, double offset1) {
  const double norm = std::hypot(nu, nw);
  return {nu / norm, nw / norm, offset0 / norm, offset1 / norm};
}

/// The side whose edges lean differently at the two ends, in sections that grow. `sign` is 1 on the
/// right and -1 on the left. A section at z has the half height y0 + y1 z and, in the middle, the
/// half width x0 + x1 z, which grows by d0 + d1 z up to the upper edge.
struct Section {
  double y0, y1, x0, x1, d0, d1;
};
kernels::TwistedSide<double> bent_side(double sign, double slant, const Section& s) {
  const double w0 = -sign * slant * s.y0 - s.d0, w1 = -sign * slant * s.y1 - s.d1;
  const double norm = std::hypot(s.y0, w0);
  return {sign * s.y0 / norm, w0 / norm, s.y0 * s.x0 / norm, (s.y0 * s.x1 + s.y1 * s.x0) / norm,
          sign * s.y1 / norm, w1 / norm, s.y1 * s.x1 / norm};
}

void set_bounds(kernels::TwistedTrap<double>& s) {
  for (const auto* side : {&s.right, &s.left}) {
    const double rate = std::hypot(side->nu1, side->nw1);
    s.steepening = std::max(s.steepening, rate);
    // Rays are followed a little way beyond the ends.
    s.steep = std::max(s.steep, 1 + 1.05 * s.hz * rate);
    s.curve = std::max(s.curve, std::abs(side->c2));
  }
}

/// The extent of the four edges along z, from points on them, with room for what lies between.
void set_extent(const kernels::TwistedTrap<double>& s, const double (&half)[2][3], double alpha,
                Extent& e) {
  constexpr int steps = 1024;
  e = {{INFINITY, INFINITY, -s.hz}, {-INFINITY, -INFINITY, s.hz}};
  double reach = 0, slope = 0;
  for (const int corner : {0, 1, 2, 3}) {
    double before_u = 0, before_w = 0;
    for (int i = 0; i <= steps; ++i) {
      const double part = static_cast<double>(i) / steps, z = s.hz * (2 * part - 1);
      const auto at = [&](int k) { return half[0][k] + part * (half[1][k] - half[0][k]); };
      const double w = corner & 1 ? at(0) : -at(0), h = corner & 1 ? at(2) : at(1);
      const double u = (corner & 2 ? h : -h) + w * std::tan(alpha);
      const double c = std::cos(s.rate * z), n = std::sin(s.rate * z);
      const double x = u * c - w * n + s.shear_x * z, y = u * n + w * c + s.shear_y * z;
      e.min.x = std::min(e.min.x, x);
      e.max.x = std::max(e.max.x, x);
      e.min.y = std::min(e.min.y, y);
      e.max.y = std::max(e.max.y, y);
      reach = std::max(reach, std::hypot(u, w));
      if (i > 0) slope = std::max(slope, std::hypot(u - before_u, w - before_w));
      before_u = u;
      before_w = w;
    }
  }
  const double turn = 2 * s.hz * std::abs(s.rate) / steps;
  const double allowance = (turn * turn * reach + 2 * turn * slope) / 8;
  e.min.x -= allowance;
  e.min.y -= allowance;
  e.max.x += allowance;
  e.max.y += allowance;
}

Solid make_twisted(std::string name, SolidKind kind, double twist, double hz, double theta,
                   double phi, double hy1, double hx1, double hx2, double hy2, double hx3,
                   double hx4, double alpha) {
  detail::require_finite({twist, hz, theta, phi, hy1, hx1, hx2, hy2, hx3, hx4, alpha}, name);
  detail::require(hz > 0 && hy1 > 0 && hx1 > 0 && hx2 > 0 && hy2 > 0 && hx3 > 0 && hx4 > 0, name,
                  "a twisted solid needs positive lengths");
  // A thinner one is nothing but surface to any navigator, and rays would be followed in it by
  // steps as short as it is thin.
  detail::require(std::min({hz, hy1, hx1, hx2, hy2, hx3, hx4}) >= 1e-9, name,
                  "a twisted solid needs half lengths of at least 1e-9 mm");
  detail::require(twist != 0 && std::abs(twist) < pi / 2, name,
                  "the twist must be less than 90 degrees and not zero");
  detail::require(theta >= 0 && theta < pi / 2 && std::abs(alpha) < pi / 2, name,
                  "theta must be from 0 to below 90 degrees, alpha between -90 and 90 degrees");
  const double lean1 = (hx2 - hx1) / (2 * hy1), lean2 = (hx4 - hx3) / (2 * hy2);
  const bool planar =
      std::abs(lean1 - lean2) * std::max(hy1, hy2) <= 1e-9 * (hx1 + hx2 + hx3 + hx4);
  const double lean = (lean1 + lean2) / 2, slant = std::tan(alpha);
  const double middle1 = (hx1 + hx2) / 2, middle2 = (hx3 + hx4) / 2;
  const double x0 = (middle1 + middle2) / 2, x1 = (middle2 - middle1) / (2 * hz);
  const double y0 = (hy1 + hy2) / 2, y1 = (hy2 - hy1) / (2 * hz);
  kernels::TwistedTrap<double> shape{hz,
                                     twist / (2 * hz),
                                     std::tan(theta) * std::cos(phi),
                                     std::tan(theta) * std::sin(phi),
                                     0,
                                     0,
                                     0,
                                     side(1, -(lean + slant), x0, x1),
                                     side(-1, slant - lean, x0, x1),
                                     side(0, -1, y0, y1),
                                     side(0, 1, y0, y1)};
  if (!planar) {
    const Section section{
        y0, y1, x0, x1, (hx2 - hx1 + hx4 - hx3) / 4, (hx4 - hx3 - hx2 + hx1) / (4 * hz)};
    shape.right = bent_side(1, slant, section);
    shape.left = bent_side(-1, slant, section);
    set_bounds(shape);
  }
  Extent extent;
  set_extent(shape, {{hy1, hx1, hx2}, {hy2, hx3, hx4}}, alpha, extent);
  shape.hx = std::max(-extent.min.x, extent.max.x);
  shape.hy = std::max(-extent.min.y, extent.max.y);
  shape.reach = std::hypot(std::max({hx1, hx2, hx3, hx4}) + std::abs(slant) * std::max(hy1, hy2),
                           std::max(hy1, hy2));
  return detail::make_solid(std::move(name), kind, shape, extent);
}

}  // namespace

Solid make_twistedtubs(std::string name, double twist, double rmin, double rmax, double z_low,
                       double z_high, double phi) {
  detail::require_finite({twist, rmin, rmax, z_low, z_high, phi}, name);
  detail::require(rmin > 0 && rmax > rmin, name,
                  "a twisted tube needs 0 < its inner < its outer radius");
  detail::require(z_high > z_low, name, "a twisted tube needs a positive length");
  detail::require(std::abs(twist) < pi, name, "the twist must be less than 180 degrees");
  if (!(phi > 0 && phi < pi)) {
    char what[128];
    std::snprintf(what, sizeof what,
                  "a twisted tube that spans %.9g degrees: it has to be more than 0 and less than "
                  "180; make it of several",
                  phi * (180 / pi));
    detail::require(false, name, what);
  }
  const double half = std::max(std::abs(z_low), std::abs(z_high));
  const double kappa = std::tan(twist / 2) / half;
  const auto face = [&](double r) {
    return kernels::Quadric<double>{1, 1, -(r * kappa) * (r * kappa), 0, -r * r, 0};
  };
  const double reach = rmax * std::hypot(1, kappa * half);
  const detail::UnitVector edge = detail::unit_vector(phi / 2);
  const kernels::TwistedTube<double> shape{reach,
                                           z_low,
                                           z_high,
                                           face(rmax),
                                           face(rmin),
                                           {-edge.y, -edge.x, kappa},
                                           {-edge.y, edge.x, kappa}};
  const double turn1 = std::atan(kappa * z_low), turn2 = std::atan(kappa * z_high);
  const double from = std::min(turn1, turn2) - phi / 2, to = std::max(turn1, turn2) + phi / 2;
  return detail::make_solid(std::move(name), SolidKind::twistedtubs, shape,
                            detail::sector_extent(rmin, reach, from, to - from, z_low, z_high));
}

Solid make_twistedbox(std::string name, double twist, double hx, double hy, double hz) {
  return make_twisted(std::move(name), SolidKind::twistedbox, twist, hz, 0, 0, hy, hx, hx, hy, hx,
                      hx, 0);
}
Solid make_twistedtrd(std::string name, double hx1, double hx2, double hy1, double hy2, double hz,
                      double twist) {
  return make_twisted(std::move(name), SolidKind::twistedtrd, twist, hz, 0, 0, hy1, hx1, hx1, hy2,
                      hx2, hx2, 0);
}
Solid make_twistedtrap(std::string name, double twist, double hz, double theta, double phi,
                       double hy1, double hx1, double hx2, double hy2, double hx3, double hx4,
                       double alpha) {
  return make_twisted(std::move(name), SolidKind::twistedtrap, twist, hz, theta, phi, hy1, hx1, hx2,
                      hy2, hx3, hx4, alpha);
}

double SolidFacts<kernels::TwistedTube<double>>::volume(const Shape& s) {
  // Every section is a sector of the same angle.
  const double angle = detail::angle_of({1, s.start.ny, -s.start.nx, -s.end.ny, s.end.nx});
  return angle / (2 * pi) *
         (detail::quadric_volume(s.outer, s.z_low, s.z_high) -
          detail::quadric_volume(s.inner, s.z_low, s.z_high));
}

double SolidFacts<kernels::TwistedTrap<double>>::volume(const Shape& s) {
  // Sections are trapezoids with parallel sides across w; twist and shear keep their area.
  const auto area = [&](double z) {
    const double height = s.back.c0 + s.back.c1 * z + s.front.c0 + s.front.c1 * z;
    const auto middle = [&](const kernels::TwistedSide<double>& f) {
      return (f.c0 + (f.c1 + f.c2 * z) * z) / (f.nu + f.nu1 * z);
    };
    return height * (middle(s.right) - middle(s.left));
  };
  return s.hz / 3 * (area(-s.hz) + 4 * area(0) + area(s.hz));
}

}  // namespace navjit
