// Random solids of flat faces, with their oracles.
#pragma once

#include <array>

#include "tests/geometry/kernels/random_solids.hpp"

namespace navjit::test {

using Corner = navjit::PlanarPoint;
using Triangle = std::array<WidePoint, 3>;

inline Wide dot(const WidePoint& a, const WidePoint& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline WidePoint minus(const WidePoint& a, const WidePoint& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline WidePoint cross(const WidePoint& a, const WidePoint& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline Wide segment_distance(const WidePoint& a, const WidePoint& b, const WidePoint& p) {
  const WidePoint u = minus(b, a), w = minus(p, a);
  const Wide k = std::clamp<Wide>(dot(u, u) > 0 ? dot(u, w) / dot(u, u) : 0, 0, 1);
  const WidePoint off{w.x - k * u.x, w.y - k * u.y, w.z - k * u.z};
  return std::sqrt(dot(off, off));
}
inline Wide triangle_distance(const Triangle& t, const WidePoint& p) {
  const WidePoint n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  bool over = dot(n, n) > 0;
  Wide least = INFINITY;
  for (std::size_t i = 0; i < 3; ++i) {
    const WidePoint &a = t[i], &b = t[(i + 1) % 3];
    over &= dot(cross(minus(b, a), minus(p, a)), n) >= 0;
    least = std::min(least, segment_distance(a, b, p));
  }
  return over ? std::abs(dot(n, minus(p, t[0]))) / std::sqrt(dot(n, n)) : least;
}
/// How much of the sphere about the point the triangle covers, with a sign.
inline Wide solid_angle(const Triangle& t, const WidePoint& p) {
  const WidePoint a = minus(t[0], p), b = minus(t[1], p), c = minus(t[2], p);
  const Wide la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
  return 2 * std::atan2(dot(a, cross(b, c)),
                        la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}
inline SignedDistance triangles_distance(std::vector<Triangle> triangles) {
  return [triangles = std::move(triangles)](const WidePoint& p) {
    Wide least = INFINITY, covered = 0;
    for (const Triangle& t : triangles) {
      least = std::min(least, triangle_distance(t, p));
      covered += solid_angle(t, p);
    }
    return std::abs(covered) > 2 * wide_pi ? -least : least;
  };
}

/// The sides of an extruded solid as triangles, and its ends as fans: that covers more than the
/// ends where the polygon is not convex, but what is covered twice has opposite signs.
inline SignedDistance extruded_distance(const std::vector<Corner>& polygon,
                                        const std::vector<ExtrudedSection>& sections) {
  return [polygon, sections](const WidePoint& p) {
    // The polygon at the height of the point, moved and scaled on from the ends beyond them.
    std::vector<Triangle> sides;
    const std::size_t n = polygon.size();
    const auto at = [&](std::size_t k, std::size_t i) {
      const ExtrudedSection& s = sections[k];
      return WidePoint{Wide(s.scale) * polygon[i % n].x + s.x,
                       Wide(s.scale) * polygon[i % n].y + s.y, s.z};
    };
    Wide least = INFINITY;
    bool in = false;
    for (std::size_t k = 0; k + 1 < sections.size(); ++k) {
      const ExtrudedSection &low = sections[k], &high = sections[k + 1];
      for (std::size_t i = 0; i < n; ++i) {
        const WidePoint a = at(k, i), b = at(k, i + 1), c = at(k + 1, i + 1), d = at(k + 1, i);
        least = std::min({least, triangle_distance(Triangle{a, b, c}, p),
                          triangle_distance(Triangle{a, c, d}, p)});
      }
      if (p.z < low.z || p.z >= high.z) continue;
      const Wide u = (p.z - low.z) / (Wide(high.z) - low.z);
      const Wide scale = low.scale + u * (Wide(high.scale) - low.scale);
      const Wide x = (p.x - low.x - u * (Wide(high.x) - low.x)) / scale;
      const Wide y = (p.y - low.y - u * (Wide(high.y) - low.y)) / scale;
      for (std::size_t i = 0; i < n; ++i) {
        const Corner &a = polygon[i], &b = polygon[(i + 1) % n];
        if ((a.y > y) != (b.y > y) && x < a.x + (b.x - a.x) * ((y - a.y) / (Wide(b.y) - a.y))) {
          in = !in;
        }
      }
    }
    // The ends: within the polygon straight across, else its edges, which the sides have.
    for (const ExtrudedSection& s : {sections.front(), sections.back()}) {
      const Wide x = (p.x - s.x) / s.scale, y = (p.y - s.y) / s.scale;
      bool over = false;
      for (std::size_t i = 0; i < n; ++i) {
        const Corner &a = polygon[i], &b = polygon[(i + 1) % n];
        if ((a.y > y) != (b.y > y) && x < a.x + (b.x - a.x) * ((y - a.y) / (Wide(b.y) - a.y))) {
          over = !over;
        }
      }
      if (over) least = std::min(least, std::abs(p.z - s.z));
    }
    return in ? -least : least;
  };
}

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

inline SolidCase random_tet(Random& random) {
  const double s = random.scale(1e-3, 1e4);
  for (;;) {
    Vec3 c[4];
    for (Vec3& p : c) p = random.point_in({{-s, -s, -s}, {s, s, s}}, 0);
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
    const double angle = i * std::numbers::pi / (rings + 1);
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

constexpr Maker flat_makers[] = {{"extruded", random_extruded},
                                 {"tet", random_tet},
                                 {"para", random_para},
                                 {"tessellated", random_tessellated}};

}  // namespace navjit::test
