// Signed distances to bodies of triangles and to extruded solids, independent of the kernels.
#pragma once

#include <array>

#include "tests/geometry/kernels/solid_oracles.hpp"

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
/// The part of the sphere about the point that the triangle covers, with a sign.
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

/// The sides of an extruded solid as triangles, and its ends as fans. These cover more than the
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

}  // namespace navjit::test
