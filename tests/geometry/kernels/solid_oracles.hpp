// Signed distance functions of the solids, made from their dimensions and independent of the
// kernels: they use angles and polygons in long double. None changes by more than the distance
// moved, so that steps of |f| along a ray cannot jump over a crossing.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "geometry/solids/solid.hpp"

namespace navjit::test {

using Wide = long double;
struct WidePoint {
  Wide x, y, z;
};
/// Negative inside; its absolute value is a lower bound of the distance to the surface.
using SignedDistance = std::function<Wide(const WidePoint&)>;

constexpr Wide wide_pi = std::numbers::pi_v<Wide>;

/// Signed distance to the sector [start, start + delta] of azimuth.
inline Wide azimuth_distance(const WidePoint& p, Wide start, Wide delta) {
  if (delta >= 2 * wide_pi - 1e-9L) return -INFINITY;
  Wide from_start = std::fmod(std::atan2(p.y, p.x) - start, 2 * wide_pi);
  if (from_start < 0) from_start += 2 * wide_pi;
  const Wide inside = std::min(from_start, delta - from_start);
  const Wide outside = std::min(from_start - delta, 2 * wide_pi - from_start);
  const Wide angle = from_start <= delta ? -inside : outside;
  const Wide across = std::hypot(p.x, p.y) * std::sin(std::min(std::abs(angle), wide_pi / 2));
  return angle < 0 ? -across : across;
}

struct PlanarPoint {
  Wide r, z;
};

/// Signed distance to a polygon in the half plane r >= 0; edges on the axis are no surface.
inline Wide polygon_distance(const std::vector<PlanarPoint>& polygon, Wide r, Wide z) {
  Wide nearest = INFINITY;
  bool in = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PlanarPoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.z > z) != (b.z > z) && r < a.r + (b.r - a.r) * ((z - a.z) / (b.z - a.z))) in = !in;
    if (a.r == 0 && b.r == 0) continue;
    const Wide dr = b.r - a.r, dz = b.z - a.z, length2 = dr * dr + dz * dz;
    Wide u = length2 > 0 ? ((r - a.r) * dr + (z - a.z) * dz) / length2 : 0;
    u = std::clamp<Wide>(u, 0, 1);
    nearest = std::min(nearest, std::hypot(r - a.r - u * dr, z - a.z - u * dz));
  }
  return in ? -nearest : nearest;
}

inline std::vector<PlanarPoint> contour(const std::vector<ZPlane>& planes) {
  std::vector<PlanarPoint> polygon;
  for (const ZPlane& plane : planes) polygon.push_back({plane.rmax, plane.z});
  for (auto plane = planes.rbegin(); plane != planes.rend(); ++plane) {
    polygon.push_back({plane->rmin, plane->z});
  }
  return polygon;
}

inline SignedDistance polycone_distance(const std::vector<ZPlane>& planes, Wide start, Wide delta) {
  return [polygon = contour(planes), start, delta](const WidePoint& p) {
    return std::max(polygon_distance(polygon, std::hypot(p.x, p.y), p.z),
                    azimuth_distance(p, start, delta));
  };
}

inline SignedDistance contour_polyhedra_distance(std::vector<PlanarPoint> polygon, int sides,
                                                 Wide start, Wide delta) {
  return [polygon = std::move(polygon), sides, start, delta](const WidePoint& p) {
    const Wide azimuth = azimuth_distance(p, start, delta);
    if (azimuth > 0) return azimuth;
    Wide from_start = std::fmod(std::atan2(p.y, p.x) - start, 2 * wide_pi);
    if (from_start < 0) from_start += 2 * wide_pi;
    // A rounding before the start is not the last side.
    if (from_start > delta && 2 * wide_pi - from_start < from_start - delta) from_start = 0;
    const Wide step = std::min(delta, 2 * wide_pi) / sides;
    const int side = std::clamp(static_cast<int>(from_start / step), 0, sides - 1);
    const Wide across = std::hypot(p.x, p.y) * std::cos(from_start - (side + 0.5L) * step);
    return std::max(polygon_distance(polygon, across, p.z), azimuth);
  };
}

inline SignedDistance polyhedra_distance(const std::vector<ZPlane>& planes, int sides, Wide start,
                                         Wide delta) {
  return contour_polyhedra_distance(contour(planes), sides, start, delta);
}

inline SignedDistance sphere_distance(Wide rmin, Wide rmax, Wide start, Wide delta,
                                      Wide start_theta, Wide delta_theta) {
  const Wide end_theta = std::min(start_theta + delta_theta, wide_pi);
  return [=](const WidePoint& p) {
    const Wide rho = std::hypot(p.x, p.y), r = std::hypot(rho, p.z);
    Wide f = std::max(r - rmax, azimuth_distance(p, start, delta));
    if (rmin > 0) f = std::max(f, rmin - r);
    const Wide theta = std::atan2(rho, p.z);
    const auto across = [&](Wide angle) {
      const Wide size = r * std::sin(std::min(std::abs(angle), wide_pi / 2));
      return angle < 0 ? -size : size;
    };
    if (start_theta > 1e-12L) f = std::max(f, across(start_theta - theta));
    if (end_theta < wide_pi - 1e-12L) f = std::max(f, across(theta - end_theta));
    return f;
  };
}

/// The distance to the convex body with these corners: 0..3 below, 4..7 above, along x first.
inline SignedDistance hexahedron_distance(const std::vector<WidePoint>& c) {
  struct Face {
    Wide a, b, c, d;
  };
  constexpr int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  std::vector<Face> faces;
  for (const auto& q : quads) {
    const WidePoint &p0 = c[q[0]], &p1 = c[q[1]], &p2 = c[q[2]], &p3 = c[q[3]];
    const WidePoint u{p2.x - p0.x, p2.y - p0.y, p2.z - p0.z};
    const WidePoint w{p3.x - p1.x, p3.y - p1.y, p3.z - p1.z};
    Face f{u.y * w.z - u.z * w.y, u.z * w.x - u.x * w.z, u.x * w.y - u.y * w.x, 0};
    const Wide norm = std::hypot(f.a, f.b, f.c);
    if (norm == 0) continue;  // a face that has shrunk to an edge or a point
    f = {f.a / norm, f.b / norm, f.c / norm, 0};
    f.d = -(f.a * (p0.x + p1.x + p2.x + p3.x) + f.b * (p0.y + p1.y + p2.y + p3.y) +
            f.c * (p0.z + p1.z + p2.z + p3.z)) /
          4;
    faces.push_back(f);
  }
  return [faces](const WidePoint& p) {
    Wide f = -INFINITY;
    for (const Face& face : faces) {
      f = std::max(f, face.a * p.x + face.b * p.y + face.c * p.z + face.d);
    }
    return f;
  };
}

inline WidePoint along(const Vec3& p, const Direction& v, Wide t) {
  return {p.x + t * v.x, p.y + t * v.y, p.z + t * v.z};
}

/// A change of sign along a ray, and how steeply the surface is crossed there.
struct Crossing {
  Wide path;   ///< infinity if the ray crosses nothing
  Wide slope;  ///< |n.v|; 1 if there is no crossing
};

/// The first change of sign of f after `from`, up to `limit`. Nothing if the ray runs so close
/// along the surface (within `resolution`) that the answer is open.
inline std::optional<Crossing> first_crossing(const SignedDistance& f, const Vec3& p,
                                              const Direction& v, Wide from, Wide limit,
                                              Wide resolution) {
  Wide t = from, value = f(along(p, v, t));
  const bool negative = value < 0;
  for (int i = 0; i < 20000; ++i) {
    if (t > limit) return Crossing{INFINITY, 1};
    const Wide next = t + std::max(std::abs(value), resolution);
    const Wide next_value = f(along(p, v, next));
    if ((next_value < 0) != negative) {
      Wide low = t, high = next;
      for (int k = 0; k < 90 && low < high; ++k) {
        const Wide middle = (low + high) / 2;
        ((f(along(p, v, middle)) < 0) == negative ? low : high) = middle;
      }
      const Wide h = resolution;
      const Wide slope = std::abs(f(along(p, v, high + h)) - f(along(p, v, high - h))) / (2 * h);
      return Crossing{high, slope};
    }
    if (std::abs(value) < resolution && t > from + 3 * resolution) return std::nullopt;
    t = next;
    value = next_value;
  }
  return std::nullopt;
}

}  // namespace navjit::test
