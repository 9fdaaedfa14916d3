// Random solids that are given by corners and contours, with their oracles.
#pragma once

#include <gtest/gtest.h>

#include "tests/geometry/kernels/facet_oracles.hpp"
#include "tests/geometry/kernels/random_solids.hpp"

namespace navjit::test {

/// A star, a comb or a convex polygon about the origin, either way round.
inline std::vector<Corner> random_polygon(Random& random, double s) {
  std::vector<Corner> polygon;
  const int kind = random.integer(0, 3);
  if (kind == 0) {
    for (const auto& [x, y] : {std::pair(-1.0, -1.0),
                               {1.0, -1.0},
                               {1.0, -0.2},
                               {0.3, -0.2},
                               {0.3, 0.4},
                               {1.0, 0.4},
                               {1.0, 1.0},
                               {-1.0, 1.0}}) {
      polygon.push_back({s * x, s * y});
    }
  } else {
    const int n = random.integer(3, 9);
    for (int i = 0; i < n; ++i) {
      const double phi = (i + random.uniform(0.1, 0.9)) * 2 * std::numbers::pi / n;
      const double r = kind == 1 ? s : s * random.uniform(0.3, 1);
      polygon.push_back({r * std::cos(phi), r * std::sin(phi)});
    }
  }
  if (random.chance(0.5)) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

inline SolidCase random_extruded(Random& random) {
  const double s = random.scale(1e-3, 1e4);
  const auto polygon = random_polygon(random, s);
  std::vector<ExtrudedSection> sections;
  double z = s * random.uniform(-1, 1);
  const int count = random.chance(0.5) ? 2 : random.integer(3, 4);
  const bool straight = random.chance(0.4);
  for (int i = 0; i < count; ++i) {
    sections.push_back({z, 0, 0, 1});
    if (!straight) {
      sections.back() = {z, s * random.uniform(-0.5, 0.5), s * random.uniform(-0.5, 0.5),
                         random.uniform(0.3, 1.5)};
    }
    z += s * random.scale(0.2, 2);
  }
  return {make_extruded("xtru", polygon, sections), extruded_distance(polygon, sections), 6 * s};
}

/// A comb with up to seven teeth, turned by any angle or by none.
inline SolidCase random_prism(Random& random) {
  const double s = random.scale(1e-3, 1e4);
  const int teeth = random.integer(2, 7);
  std::vector<Corner> polygon{{s, s * random.uniform(-1.5, -0.8)}};
  for (int i = 0; i < teeth; ++i) {
    const double low = s * (2.0 * i / teeth - 1), width = s * random.uniform(0.2, 1.5) / teeth;
    const double top = s * random.uniform(0, 1), bottom = -0.5 * s;
    const double lean = random.chance(0.5) ? 0 : 0.1 * s / teeth;
    const double right = -low, left = right - width;
    polygon.push_back({right, bottom});
    polygon.push_back({right - lean, top});
    polygon.push_back({left + lean, top});
    polygon.push_back({left, bottom});
  }
  polygon.push_back({-s, polygon[0].y});
  const double phi = random.chance(0.5) ? 0 : random.uniform(0, 7), c = std::cos(phi),
               sine = std::sin(phi);
  for (Corner& p : polygon) p = {c * p.x - sine * p.y, sine * p.x + c * p.y};
  if (random.chance(0.5)) std::reverse(polygon.begin(), polygon.end());
  const double z = s * random.uniform(-1, 1), dx = s * random.uniform(-1, 1);
  const std::vector<ExtrudedSection> sections{{z, dx, 0, 0.7},
                                              {z + s * random.scale(0.05, 2), dx, 0, 0.7}};
  SolidCase made{make_extruded("prism", polygon, sections), extruded_distance(polygon, sections),
                 6 * s};
  EXPECT_EQ(made.solid.kind, SolidKind::prism);
  return made;
}

inline SolidCase random_tet(Random& random) {
  const double s = random.scale(1e-3, 1e4);
  for (;;) {
    // Every other corner of a cube, shaken.
    Vec3 c[4];
    for (int i = 0; i < 4; ++i) {
      const auto shaken = [&](bool high) { return s * (random.uniform(0.6, 1) * (high ? 1 : -1)); };
      c[i] = {shaken(i == 1 || i == 2), shaken(i == 1 || i == 3), shaken(i == 2 || i == 3)};
    }
    WidePoint w[4];
    for (int i = 0; i < 4; ++i) w[i] = {c[i].x, c[i].y, c[i].z};
    const Wide volume = dot(minus(w[1], w[0]), cross(minus(w[2], w[0]), minus(w[3], w[0])));
    if (std::abs(volume) < 0.5L * s * s * s) continue;
    if (volume < 0) std::swap(w[2], w[3]);
    return {make_tet("tet", c[0], c[1], c[2], c[3]),
            triangles_distance(
                {{w[0], w[2], w[1]}, {w[0], w[1], w[3]}, {w[1], w[2], w[3]}, {w[0], w[3], w[2]}}),
            2 * s};
  }
}

inline SolidCase random_para(Random& random) {
  const double s = random.scale(1e-3, 1e4);
  const double x = s * random.scale(0.1, 1), y = s * random.scale(0.1, 1);
  const double z = s * random.scale(0.1, 1);
  const double alpha = random.uniform(-0.8, 0.8), theta = random.uniform(0, 0.8);
  const double phi = random.uniform(-4, 4);
  std::vector<WidePoint> corners;
  for (int i = 0; i < 8; ++i) {
    const Wide w = i & 4 ? z : -z, v = i & 2 ? y : -y, tilt = w * std::tan(Wide(theta));
    corners.push_back({(i & 1 ? x : -x) + v * std::tan(Wide(alpha)) + tilt * std::cos(Wide(phi)),
                       v + tilt * std::sin(Wide(phi)), w});
  }
  return {make_para("para", x, y, z, alpha, theta, phi), hexahedron_distance(corners), 4 * s};
}

/// A ball or a bowl of triangles and flat quadrilaterals.
inline SolidCase random_tessellated(Random& random) {
  const double s = random.scale(1e-3, 1e4);
  const int around = random.integer(3, 8), rings = random.integer(1, 3);
  const bool bowl = random.chance(0.5);
  // A closed contour in (r, z) from the axis to the axis, turned in steps.
  std::vector<Corner> contour;
  for (int i = 1; i <= rings; ++i) {
    const double angle = i * std::numbers::pi / (bowl ? 2 * rings : rings + 1);
    contour.push_back({s * std::sin(angle) * random.uniform(0.8, 1), -s * std::cos(angle)});
  }
  const double top = bowl ? -0.6 * s : s;
  if (bowl) contour.push_back({s * random.uniform(0.85, 0.95), 0.9 * s});
  std::vector<FacetCorners> facets;
  const auto at = [&](std::size_t k, int i) {
    const double phi = 0.3 + (i % around) * 2 * std::numbers::pi / around;
    return Vec3{contour[k].x * std::cos(phi), contour[k].x * std::sin(phi), contour[k].y};
  };
  for (int i = 0; i < around; ++i) {
    facets.push_back({Vec3{0, 0, -s}, at(0, i + 1), at(0, i)});
    for (std::size_t k = 0; k + 1 < contour.size(); ++k) {
      facets.push_back({at(k, i), at(k, i + 1), at(k + 1, i + 1), at(k + 1, i)});
    }
    facets.push_back({at(contour.size() - 1, i), at(contour.size() - 1, i + 1), Vec3{0, 0, top}});
  }
  std::vector<Triangle> triangles;
  for (const FacetCorners& f : facets) {
    const auto corner = [&](std::size_t i) { return WidePoint{f[i].x, f[i].y, f[i].z}; };
    triangles.push_back({corner(0), corner(1), corner(2)});
    if (f.size() == 4) triangles.push_back({corner(0), corner(2), corner(3)});
  }
  if (random.chance(0.3)) {
    for (FacetCorners& f : facets) std::reverse(f.begin(), f.end());
  }
  return {make_tessellated("mesh", facets), triangles_distance(std::move(triangles)), 2 * s};
}

/// Not a distance but a lower bound of it: the test of exact slopes must not use it.
inline SignedDistance arb8_distance(const std::vector<Corner>& corners, Wide hz) {
  return [corners, hz](const WidePoint& p) {
    const Wide u = std::clamp<Wide>(p.z / hz, -1, 1);
    const auto at = [&](std::size_t i) {
      const Corner &a = corners[i % 4], &b = corners[i % 4 + 4];
      return std::pair((Wide(a.x) * (1 - u) + b.x * (1 + u)) / 2,
                       (Wide(a.y) * (1 - u) + b.y * (1 + u)) / 2);
    };
    // The distance within the plane z, and no more than what the slope of the sides leaves of it.
    Wide across = -INFINITY, slope = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [ax, ay] = at(i);
      const auto [bx, by] = at(i + 1);
      const Wide ex = bx - ax, ey = by - ay, length = std::hypot(ex, ey);
      if (!(length > 0)) continue;
      across = std::max(across, ((p.x - ax) * ey - (p.y - ay) * ex) / length);
      const Corner &a = corners[i % 4], &b = corners[i % 4 + 4];
      slope = std::max(slope, std::hypot(Wide(b.x) - a.x, Wide(b.y) - a.y) / (2 * hz));
    }
    return std::max(across / (4 * (1 + slope)), std::abs(p.z) - hz);
  };
}

/// A trap of size `s` with sides that are not planar. If no corner is 1e-5 mm off, make_trap takes
/// the sides as planar and makes their mean planes: for a trap of some micrometres this is visibly
/// another solid than the arb8 of its corners.
inline SolidCase bent_trap(Random& random, double s) {
  const double hz = s * random.scale(0.5, 2);
  const double theta = random.uniform(-0.5, 0.5), phi = random.uniform(-3, 3);
  double y[2], x[2][2], alpha[2];
  std::vector<Corner> corners;
  for (int end = 0; end < 2; ++end) {
    y[end] = s * random.scale(0.3, 1);
    alpha[end] = random.uniform(-0.3, 0.3);
    for (double& half : x[end]) half = s * random.scale(0.4, 1);
    const Wide shift = (end == 0 ? -hz : hz) * std::tan(Wide(theta));
    for (const int corner : {0, 1, 3, 2}) {
      const int high = corner / 2;
      const Wide across = high ? y[end] : -y[end];
      const Wide half = corner % 2 ? x[end][high] : -x[end][high];
      corners.push_back({static_cast<double>(shift * std::cos(Wide(phi)) + half +
                                             across * std::tan(Wide(alpha[end]))),
                         static_cast<double>(shift * std::sin(Wide(phi)) + across)});
    }
  }
  Solid solid = make_trap("bent", hz, theta, phi, y[0], x[0][0], x[0][1], alpha[0], y[1], x[1][0],
                          x[1][1], alpha[1]);
  const double size = 4 * std::max(s, hz);
  if (solid.kind != SolidKind::trap) return {std::move(solid), arb8_distance(corners, hz), size};
  std::vector<WidePoint> planar;
  for (const std::size_t i : {0, 1, 3, 2, 4, 5, 7, 6}) {
    planar.push_back({corners[i].x, corners[i].y, i < 4 ? -hz : hz});
  }
  return {std::move(solid), hexahedron_distance(planar), size};
}
inline SolidCase random_bent_trap(Random& random) {
  return bent_trap(random, random.scale(1e-3, 1e4));
}
inline SolidCase random_small_bent_trap(Random& random) {
  return bent_trap(random, random.scale(1e-5, 1e-3));
}

inline SolidCase random_arb8(Random& random) {
  const double s = random.scale(1e-3, 1e4), hz = s * random.scale(0.3, 2);
  const double twist = random.chance(0.2) ? 0 : random.uniform(-0.8, 0.8);
  std::vector<Corner> corners;
  for (const double turn : {0.0, twist}) {
    const double scale = random.uniform(0.5, 1);
    for (int i = 0; i < 4; ++i) {
      const double phi = turn + (i + random.uniform(-0.15, 0.15)) * std::numbers::pi / 2;
      corners.push_back({scale * s * std::cos(phi), scale * s * std::sin(phi)});
    }
  }
  std::vector<Corner> given = corners;
  if (random.chance(0.5)) {
    std::swap(given[1], given[3]);
    std::swap(given[5], given[7]);
  }
  return {make_arb8("arb8", hz, std::span<const Corner, 8>(given.data(), 8)),
          arb8_distance(corners, hz), 2 * std::max(s, hz)};
}

/// Corners that are given to a few digits: the sides twist a little.
inline SolidCase random_nearly_flat_arb8(Random& random) {
  const double s = random.scale(1e-3, 1e4), hz = s * random.scale(0.3, 5);
  const double slack = s * random.scale(1e-12, 3e-2);
  std::vector<Corner> corners;
  const double narrow = random.uniform(0.3, 1), x = random.uniform(-0.3, 0.3) * s;
  double phi[4], rho[4];
  for (int i = 0; i < 4; ++i) {
    phi[i] = (i + random.uniform(-0.2, 0.2)) * std::numbers::pi / 2;
    rho[i] = s * random.uniform(0.8, 1);
  }
  for (const double scale : {1.0, narrow}) {
    for (int i = 0; i < 4; ++i) {
      const double slip = random.uniform(-slack, slack), slide = random.uniform(-slack, slack);
      corners.push_back({scale * rho[i] * std::cos(phi[i]) + (1 - scale) * x + slip,
                         scale * rho[i] * std::sin(phi[i]) + slide});
    }
  }
  return {make_arb8("arb8", hz, std::span<const Corner, 8>(corners.data(), 8)),
          arb8_distance(corners, hz), 2 * std::max(s, hz)};
}

inline SolidCase random_cut_tube(Random& random) {
  const double rmax = random.scale(1e-3, 1e4), hz = rmax * random.scale(1.5, 20);
  const double rmin = random.chance(0.4) ? 0 : rmax * random.uniform(0.1, 0.9);
  const Segment phi = random_segment(random);
  const auto normal = [&](double z) {
    return Vec3{random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), z};
  };
  const Vec3 low = normal(-1), high = normal(1);
  const SignedDistance tube =
      polycone_distance({{-9 * hz, rmin, rmax}, {9 * hz, rmin, rmax}}, phi.start, phi.delta);
  const auto beyond = [hz](const Vec3& n, const WidePoint& p) {
    const Wide z = n.z < 0 ? -hz : hz;
    return (n.x * p.x + n.y * p.y + n.z * (p.z - z)) / std::hypot(Wide(n.x), Wide(n.y), Wide(n.z));
  };
  return {make_cut_tube("cut", rmin, rmax, hz, phi.start, phi.delta, low, high),
          [=](const WidePoint& p) {
            return std::max({tube(p), beyond(low, p), beyond(high, p)});
          },
          2 * (hz + rmax)};
}

/// A contour that no list of z planes can give: a hollow that opens outwards.
inline std::vector<PlanarPoint> hollow_contour(double s) {
  return {{0.3L * s, -s},       {s, -s},       {0.9L * s, -0.4L * s}, {0.5L * s, -0.2L * s},
          {0.6L * s, 0.3L * s}, {s, 0.5L * s}, {0.9L * s, s},         {0.4L * s, 0.8L * s}};
}
inline std::vector<ContourPoint> points_of(const std::vector<PlanarPoint>& contour, double factor) {
  std::vector<ContourPoint> points;
  for (const PlanarPoint& p : contour) {
    points.push_back({static_cast<double>(p.r) * factor, static_cast<double>(p.z)});
  }
  return points;
}

inline SolidCase random_generic_polycone(Random& random) {
  const double s = random.scale(1e-3, 1e4);
  auto contour = hollow_contour(s);
  if (random.chance(0.5)) std::reverse(contour.begin(), contour.end());
  const Segment phi = random_segment(random);
  return {make_generic_polycone("contour", points_of(contour, 1), phi.start, phi.delta),
          [contour, phi](const WidePoint& p) {
            return std::max(polygon_distance(contour, std::hypot(p.x, p.y), p.z),
                            azimuth_distance(p, phi.start, phi.delta));
          },
          2 * s};
}

inline SolidCase random_generic_polyhedra(Random& random) {
  const double s = random.scale(1e-3, 1e4);
  const auto contour = hollow_contour(s);
  const int sides = random.integer(3, 9);
  const Segment phi = random_segment(random);
  const double delta = std::min(phi.delta, 2 * std::numbers::pi);
  const double factor = 1 / std::cos(delta / sides / 2);
  return {
      make_generic_polyhedra("contour", points_of(contour, factor), sides, phi.start, phi.delta),
      contour_polyhedra_distance(contour, sides, phi.start, phi.delta), 4 * s};
}

inline SolidCase random_scaled(Random& random) {
  const double s = random.scale(1e-3, 1e3);
  const double planes[3] = {random.uniform(0.3, 2), random.uniform(0.3, 2), random.uniform(0.3, 2)};
  const double sign = random.chance(0.5) ? 1 : -1;
  const double x = sign * planes[0], y = planes[1], z = planes[2];
  const Segment phi = random_segment(random);
  const SignedDistance f =
      polycone_distance({{-s, s / 3, s}, {s, s / 2, s / 1.5}}, phi.start, phi.delta);
  const double least = std::min({planes[0], planes[1], planes[2]});
  return {make_scaled("scaled", make_cone("c", s / 3, s, s / 2, s / 1.5, s, phi.start, phi.delta),
                      x, y, z),
          [=](const WidePoint& p) {
            return least * f({p.x / x, p.y / y, p.z / z});
          },
          4 * s};
}

constexpr Maker flat_makers[] = {{"extruded", random_extruded},
                                 {"prism", random_prism},
                                 {"tet", random_tet},
                                 {"para", random_para},
                                 {"tessellated", random_tessellated},
                                 {"arb8", random_arb8},
                                 {"nearly_flat_arb8", random_nearly_flat_arb8},
                                 {"bent_trap", random_bent_trap},
                                 {"small_bent_trap", random_small_bent_trap},
                                 {"cut_tube", random_cut_tube},
                                 {"generic_polycone", random_generic_polycone},
                                 {"generic_polyhedra", random_generic_polyhedra},
                                 {"scaled", random_scaled}};

}  // namespace navjit::test
