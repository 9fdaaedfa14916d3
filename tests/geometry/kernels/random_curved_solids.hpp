// Random tori, solids behind quadrics and twisted solids, with their oracles.
#pragma once

#include "tests/geometry/kernels/random_solids.hpp"

namespace navjit::test {

inline SolidCase any_torus(Random& random, bool spindle) {
  const double s = random.scale(1e-3, 1e4), rmax = s * random.scale(0.02, spindle ? 3 : 0.99);
  const double rmin = random.chance(0.4) ? 0 : rmax * (1 - random.scale(0.01, 1));
  const Segment phi = random_segment(random);
  const SignedDistance f = [=](const WidePoint& p) {
    const Wide d = std::hypot(std::hypot(p.x, p.y) - Wide(s), p.z);
    const Wide shell = rmin > 0 ? std::max(d - rmax, rmin - d) : d - rmax;
    return std::max(shell, azimuth_distance(p, phi.start, phi.delta));
  };
  return {make_torus("torus", rmin, rmax, s, phi.start, phi.delta), f, 2 * (s + rmax)};
}

inline SolidCase random_torus(Random& random) { return any_torus(random, false); }
inline SolidCase random_wide_torus(Random& random) { return any_torus(random, true); }

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
  const double r2 = s * random.scale(0.2, 1),
               r1 = random.chance(0.3) ? 0 : r2 * random.uniform(0, 0.95);
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

/// Sides of a section that turns along z, within a box; `sides` are outward distances in its frame.
template <class Sides>
SignedDistance twisted_distance(Wide hx, Wide hy, Wide hz, Wide steepest, Sides sides) {
  return [=](const WidePoint& p) {
    const Wide beyond = std::max({std::abs(p.x) - hx, std::abs(p.y) - hy, std::abs(p.z) - hz});
    // Far away the sides say nothing.
    if (beyond > 0.1L * std::min({hx, hy, hz})) return beyond;
    return std::max(sides(p) / steepest, std::abs(p.z) - hz);
  };
}

inline SolidCase twisted_case(const Solid& solid, double twist, double hz, double theta, double phi,
                              double y1, double x1, double x2, double y2, double x3, double x4,
                              double alpha) {
  const Wide tx = std::tan(Wide(theta)) * std::cos(Wide(phi));
  const Wide ty = std::tan(Wide(theta)) * std::sin(Wide(phi));
  const Extent& e = solid.extent;
  const Wide hx = std::max(-e.min.x, e.max.x), hy = std::max(-e.min.y, e.max.y);
  const Wide rate = Wide(twist) / (2 * Wide(hz)), slant = std::tan(Wide(alpha));
  const auto sides = [=](const WidePoint& p) {
    const Wide part = (p.z / hz + 1) / 2, angle = rate * p.z;
    const Wide x = p.x - tx * p.z, y = p.y - ty * p.z;
    const Wide u = x * std::cos(angle) + y * std::sin(angle);
    const Wide w = y * std::cos(angle) - x * std::sin(angle);
    const auto at = [&](Wide low, Wide high) { return low + part * (high - low); };
    const Wide h = at(y1, y2), low = at(x1, x3), high = at(x2, x4);
    const Wide lean = (high - low) / (2 * h), middle = (low + high) / 2;
    const Wide right = (u - slant * w - middle - lean * w) / std::hypot(1.0L, slant + lean);
    const Wide left = (-u + slant * w - middle - lean * w) / std::hypot(1.0L, slant - lean);
    return std::max({std::abs(w) - h, right, left});
  };
  const Wide taper = (std::abs(x3 - x1) + std::abs(x4 - x2) + std::abs(y2 - y1)) / (2 * hz);
  const Wide shear = std::hypot(tx, ty);
  const Wide bent = std::abs((Wide(x2) - x1) / y1 - (Wide(x4) - x3) / y2) / (4 * hz);
  const Wide steepest = 1 + (std::abs(rate) + bent) * (std::hypot(hx, hy) + shear * hz) * 1.2L +
                        shear + taper + bent * 4 * std::max(y1, y2);
  return {solid, twisted_distance(hx, hy, hz, steepest, sides),
          2 * std::max({e.max.x - e.min.x, e.max.y - e.min.y, 2 * hz})};
}

inline double random_twist(Random& random) {
  return (random.chance(0.5) ? 1 : -1) * random.scale(0.01, 1.57);
}
inline SolidCase random_twistedbox(Random& random) {
  const double s = random.scale(1e-3, 1e4), twist = random_twist(random);
  const double x = s * random.scale(0.2, 1), y = s * random.scale(0.2, 1);
  const double z = s * random.scale(0.3, 3);
  return twisted_case(make_twistedbox("t", twist, x, y, z), twist, z, 0, 0, y, x, x, y, x, x, 0);
}
inline SolidCase random_twistedtrd(Random& random) {
  const double s = random.scale(1e-3, 1e4), twist = random_twist(random);
  const double x1 = s * random.scale(0.2, 1), y1 = s * random.scale(0.2, 1);
  const double x2 = s * random.scale(0.2, 1), y2 = s * random.scale(0.2, 1);
  const double z = s * random.scale(0.3, 3);
  return twisted_case(make_twistedtrd("t", x1, x2, y1, y2, z, twist), twist, z, 0, 0, y1, x1, x1,
                      y2, x2, x2, 0);
}
inline SolidCase random_twistedtrap(Random& random) {
  const double s = random.scale(1e-3, 1e4), twist = random_twist(random);
  const double x1 = s * random.scale(0.2, 1), x2 = s * random.scale(0.2, 1);
  const double y1 = s * random.scale(0.2, 1), ratio = random.scale(0.5, 2);
  const double theta = random.uniform(0, 0.6), phi = random.uniform(-3, 3);
  const double alpha = random.uniform(-0.6, 0.6), z = s * random.scale(0.3, 3);
  return twisted_case(make_twistedtrap("t", twist, z, theta, phi, y1, x1, x2, ratio * y1,
                                       ratio * x1, ratio * x2, alpha),
                      twist, z, theta, phi, y1, x1, x2, ratio * y1, ratio * x1, ratio * x2, alpha);
}
inline SolidCase random_bent_twistedtrap(Random& random) {
  const double s = random.scale(1e-3, 1e4), twist = random_twist(random);
  const auto half = [&] { return s * random.scale(0.3, 1); };
  const double x1 = half(), x2 = half(), x3 = half(), x4 = half();
  const double y1 = half(), y2 = random.chance(0.5) ? y1 : half();
  const double theta = random.uniform(0, 0.6), phi = random.uniform(-3, 3);
  const double alpha = random.uniform(-0.6, 0.6), z = s * random.scale(0.3, 3);
  return twisted_case(make_twistedtrap("t", twist, z, theta, phi, y1, x1, x2, y2, x3, x4, alpha),
                      twist, z, theta, phi, y1, x1, x2, y2, x3, x4, alpha);
}
inline SolidCase random_twistedtubs(Random& random) {
  const double s = random.scale(1e-3, 1e4), rmin = s * random.uniform(0.1, 0.9);
  const double twist = random.uniform(-2, 2), phi = random.uniform(0.2, 3);
  const double low = -s * random.scale(0.2, 2);
  const double high = random.chance(0.6) ? -low : low + s * random.scale(0.2, 3);
  const Solid solid = make_twistedtubs("t", twist, rmin, s, low, high, phi);
  const Wide half = std::max(std::abs(low), std::abs(high));
  const Wide kappa = std::tan(Wide(twist) / 2) / half, end = s * std::hypot(1.0L, kappa * half);
  const auto sides = [=](const WidePoint& p) {
    const Wide rho = std::hypot(p.x, p.y), wide = std::hypot(1.0L, kappa * p.z);
    const Wide azimuth =
        std::abs(std::remainder(std::atan2(p.y, p.x) - std::atan(kappa * p.z), 2 * wide_pi));
    const Wide across =
        rho * std::sin(std::clamp<Wide>(azimuth - phi / 2, -wide_pi / 2, wide_pi / 2));
    return std::max({rho - s * wide, rmin * wide - rho, across});
  };
  const SignedDistance f = [=](const WidePoint& p) {
    const Wide beyond = std::max({std::hypot(p.x, p.y) - end, p.z - high, low - p.z});
    if (beyond > 0.1L * s) return beyond;
    return std::max({sides(p) / (1 + 1.2L * std::abs(kappa) * (end + s)), p.z - high, low - p.z});
  };
  return {solid, f, static_cast<double>(2 * std::max({end, half, 0.5L * s}))};
}

constexpr Maker curved_makers[] = {{"torus", random_torus},
                                   {"wide_torus", random_wide_torus},
                                   {"ellipsoid", random_ellipsoid},
                                   {"eltube", random_eltube},
                                   {"elcone", random_elcone},
                                   {"paraboloid", random_paraboloid},
                                   {"hype", random_hype},
                                   {"twistedtubs", random_twistedtubs},
                                   {"twistedbox", random_twistedbox},
                                   {"twistedtrd", random_twistedtrd},
                                   {"twistedtrap", random_twistedtrap},
                                   {"bent_twistedtrap", random_bent_twistedtrap}};

}  // namespace navjit::test
