// Random tori, solids behind quadrics and twisted solids, with their oracles.
#pragma once

#include "tests/geometry/kernels/random_solids.hpp"

namespace navjit::test {

inline SolidCase random_torus(Random& random) {
  const double s = random.scale(1e-3, 1e4), rmax = s * random.scale(0.02, 0.99);
  const double rmin = random.chance(0.4) ? 0 : rmax * (1 - random.scale(0.01, 1));
  const Segment phi = random_segment(random);
  const SignedDistance f = [=](const WidePoint& p) {
    const Wide d = std::hypot(std::hypot(p.x, p.y) - Wide(s), p.z);
    const Wide shell = rmin > 0 ? std::max(d - rmax, rmin - d) : d - rmax;
    return std::max(shell, azimuth_distance(p, phi.start, phi.delta));
  };
  return {make_torus("torus", rmin, rmax, s, phi.start, phi.delta), f, 2 * (s + rmax)};
}

inline SolidCase random_ellipsoid(Random& random) {
  const double s = random.scale(1e-3, 1e4);
  const double a = s * random.scale(0.1, 1), b = s * random.scale(0.1, 1), c = s;
  double low = -c, high = c;
  if (random.chance(0.6)) low = c * random.uniform(-0.9, 0.8);
  if (random.chance(0.6)) high = std::min(low + c * random.uniform(0.1, 1.9), 1.2 * c);
  const double given_low = low == -c && random.chance(0.5) ? -1.5 * c : low;
  const SignedDistance f = [=](const WidePoint& p) {
    const Wide k = std::hypot(p.x / a, p.y / b, p.z / c);
    return std::max({(k - 1) * std::min({a, b, c}), low - p.z, p.z - high});
  };
  return {make_ellipsoid("ellipsoid", a, b, c, given_low, high), f, 2 * s};
}

inline SolidCase random_eltube(Random& random) {
  const double s = random.scale(1e-3, 1e4), hz = s * random.scale(0.1, 5);
  const double a = s * random.scale(0.1, 1), b = s * random.scale(0.1, 1);
  const SignedDistance f = [=](const WidePoint& p) {
    return std::max((std::hypot(p.x / a, p.y / b) - 1) * std::min(a, b), std::abs(p.z) - hz);
  };
  return {make_eltube("eltube", a, b, hz), f, 2 * std::max(s, hz)};
}

inline SolidCase random_elcone(Random& random) {
  const double s = random.scale(1e-3, 1e4), height = s;
  const double a = random.scale(0.2, 1.5), b = random.scale(0.2, 1.5);
  const double cut = random.chance(0.3) ? height : height * random.uniform(0.1, 0.95);
  const SignedDistance f = [=](const WidePoint& p) {
    const Wide k = std::hypot(p.x / a, p.y / b) - (height - p.z);
    return std::max(k / std::sqrt(1 + 1 / Wide(std::min(a * a, b * b))), std::abs(p.z) - cut);
  };
  return {make_elcone("elcone", a, b, height, cut), f, 4 * s};
}

inline SolidCase random_paraboloid(Random& random) {
  const double s = random.scale(1e-3, 1e4), hz = s * random.scale(0.1, 1);
  const double r2 = s * random.scale(0.2, 1), r1 = random.chance(0.3) ? 0 : r2 * random.uniform(0, 0.95);
  // The distance from the focus less that from the directrix.
  const Wide rise = (Wide(r2) * r2 - Wide(r1) * r1) / (2 * hz), tip = -hz - r1 * r1 / rise;
  const SignedDistance f = [=](const WidePoint& p) {
    const Wide u = p.z - tip;
    const Wide k = std::hypot(p.x, p.y, u - rise / 4) - (u + rise / 4);
    return std::max(k / 2, std::abs(p.z) - hz);
  };
  return {make_paraboloid("paraboloid", r1, r2, hz), f, 2 * s};
}

inline SolidCase random_hype(Random& random) {
  const double s = random.scale(1e-3, 1e4), hz = s * random.scale(0.2, 2);
  const double rmin = random.chance(0.3) ? 0 : s * random.uniform(0.1, 0.9);
  double inner = random.chance(0.3) ? 0 : random.uniform(0, 1);
  double outer = random.chance(0.2) ? 0 : random.uniform(0, 1);
  if (inner > outer) std::swap(inner, outer);
  const SignedDistance f = [=](const WidePoint& p) {
    const Wide rho = std::hypot(p.x, p.y);
    const Wide ti = std::tan(Wide(inner)), to = std::tan(Wide(outer));
    Wide k = (rho - std::hypot(to * p.z, Wide(s))) / std::hypot(to, 1.0L);
    if (rmin > 0 || inner > 0) {
      k = std::max(k, (std::hypot(ti * p.z, Wide(rmin)) - rho) / std::hypot(ti, 1.0L));
    }
    return std::max(k, std::abs(p.z) - hz);
  };
  return {make_hype("hype", rmin, s, inner, outer, hz), f, 2 * std::max(2 * s, hz)};
}

constexpr Maker curved_makers[] = {
    {"torus", random_torus},   {"ellipsoid", random_ellipsoid},   {"eltube", random_eltube},
    {"elcone", random_elcone}, {"paraboloid", random_paraboloid}, {"hype", random_hype}};

}  // namespace navjit::test
