// Random solids of every kind, with their oracles.
#pragma once

#include <string>

#include "tests/geometry/kernels/random.hpp"
#include "tests/geometry/kernels/solid_oracles.hpp"

namespace navjit::test {

/// A solid, its oracle, and its rough size, mm.
struct SolidCase {
  Solid solid;
  SignedDistance distance;
  double size;

  /// A tolerance like that of navigation: far above rounding, far below all dimensions.
  double tolerance() const { return 1e-10 * size; }
};

struct Segment {
  double start, delta;
};
inline Segment random_segment(Random& random) {
  constexpr double pi = std::numbers::pi;
  if (random.chance(0.4)) return {0, 2 * pi};
  if (random.chance(0.3)) return {random.integer(-4, 4) * pi / 2, random.integer(1, 3) * pi / 2};
  return {random.uniform(-7, 7), random.uniform(0.1, 6.1)};
}

inline SolidCase random_box(Random& random) {
  const double s = random.scale(1e-3, 1e4);
  const double x = s * random.scale(0.01, 1), y = s * random.scale(0.01, 1), z = s;
  std::vector<WidePoint> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back({i & 1 ? x : -x, i & 2 ? y : -y, i & 4 ? z : -z});
  }
  return {make_box("box", x, y, z), hexahedron_distance(corners), 2 * s};
}

inline SolidCase random_tube(Random& random) {
  const double rmax = random.scale(1e-3, 1e4), hz = rmax * random.scale(0.02, 20);
  const double rmin = random.chance(0.4) ? 0 : rmax * (1 - random.scale(0.01, 1));
  const Segment phi = random_segment(random);
  return {make_tube("tube", rmin, rmax, hz, phi.start, phi.delta),
          polycone_distance({{-hz, rmin, rmax}, {hz, rmin, rmax}}, phi.start, phi.delta),
          2 * std::max(rmax, hz)};
}

inline SolidCase random_cone(Random& random) {
  const double s = random.scale(1e-3, 1e4), hz = s * random.scale(0.02, 20);
  double rmax1 = s * random.scale(0.02, 1), rmax2 = s * random.scale(0.02, 1);
  double rmin1 = rmax1 * random.uniform(0, 1), rmin2 = rmax2 * random.uniform(0, 1);
  if (random.chance(0.4)) rmin1 = rmin2 = 0;
  if (random.chance(0.15)) rmax1 = rmin1 = 0;
  if (random.chance(0.15)) rmin2 = rmax2;
  if (random.chance(0.1)) rmin1 = 0;
  if (random.chance(0.1)) rmax2 = std::max(rmax1, rmin2);
  if (rmin1 == rmax1 && rmin2 == rmax2) rmax1 += s;
  const Segment phi = random_segment(random);
  return {make_cone("cone", rmin1, rmax1, rmin2, rmax2, hz, phi.start, phi.delta),
          polycone_distance({{-hz, rmin1, rmax1}, {hz, rmin2, rmax2}}, phi.start, phi.delta),
          2 * std::max(s, hz)};
}

inline SolidCase random_trd(Random& random) {
  const double s = random.scale(1e-3, 1e4), hz = s * random.scale(0.05, 1);
  double h[4];
  for (double& half : h) half = s * random.scale(0.02, 1);
  if (random.chance(0.2)) h[random.integer(0, 1)] = 0;
  if (random.chance(0.2)) h[random.integer(2, 3)] = 0;
  if (random.chance(0.2)) h[1] = h[0] = std::max(h[0], h[1]);
  std::vector<WidePoint> corners;
  for (int i = 0; i < 8; ++i) {
    const double x = h[i & 4 ? 1 : 0], y = h[i & 4 ? 3 : 2];
    corners.push_back({i & 1 ? x : -x, i & 2 ? y : -y, i & 4 ? hz : -hz});
  }
  return {make_trd("trd", h[0], h[1], h[2], h[3], hz), hexahedron_distance(corners),
          2 * std::max(s, hz)};
}

inline SolidCase random_trap(Random& random) {
  const double s = random.scale(1e-3, 1e4), hz = s * random.scale(0.1, 1);
  // Planar sides: the upper face is the lower one scaled.
  const double theta = random.uniform(-0.8, 0.8), phi = random.uniform(-4, 4);
  const double alpha = random.uniform(-0.8, 0.8), ratio = random.scale(0.3, 3);
  const double y1 = s * random.scale(0.05, 1), x1 = s * random.scale(0.05, 1);
  const double x2 = random.chance(0.3) ? x1 : s * random.scale(0.05, 1);
  const double y2 = ratio * y1, x3 = ratio * x1, x4 = ratio * x2;
  const Wide slant = std::tan(static_cast<Wide>(alpha)), tilt = std::tan(static_cast<Wide>(theta));
  std::vector<WidePoint> corners;
  for (int i = 0; i < 8; ++i) {
    const Wide z = i & 4 ? hz : -hz, k = i & 4 ? ratio : 1;
    const Wide y = k * (i & 2 ? y1 : -y1), half = k * (i & 2 ? x2 : x1);
    const Wide x = y * slant + (i & 1 ? half : -half);
    corners.push_back({x + z * tilt * std::cos(static_cast<Wide>(phi)),
                       y + z * tilt * std::sin(static_cast<Wide>(phi)), z});
  }
  return {make_trap("trap", hz, theta, phi, y1, x1, x2, alpha, y2, x3, x4, alpha),
          hexahedron_distance(corners), 6 * s};
}

inline SolidCase random_orb(Random& random) {
  const double r = random.scale(1e-3, 1e4);
  return {make_orb("orb", r), [r](const WidePoint& p) { return std::hypot(p.x, p.y, p.z) - r; },
          2 * r};
}

inline SolidCase random_sphere(Random& random) {
  constexpr double pi = std::numbers::pi;
  const double rmax = random.scale(1e-3, 1e4);
  const double rmin = random.chance(0.4) ? 0 : rmax * (1 - random.scale(0.01, 1));
  const Segment phi = random_segment(random);
  double start = 0, delta = pi;
  if (random.chance(0.7)) {
    start = random.chance(0.3) ? 0 : random.uniform(0.05, 2.8);
    delta = random.uniform(0.1, pi - start + 0.3);
    if (random.chance(0.2)) delta = pi - start;
    if (random.chance(0.2)) start = pi / 2;
    if (random.chance(0.2) && start < pi / 2) delta = pi / 2 - start;
  }
  return {make_sphere("sphere", rmin, rmax, phi.start, phi.delta, start, delta),
          sphere_distance(rmin, rmax, phi.start, phi.delta, start, delta), 2 * rmax};
}

/// Planes of ascending (or descending) z with steps; rings always touch at a step.
inline std::vector<ZPlane> random_planes(Random& random, double s) {
  std::vector<ZPlane> planes;
  double z = s * random.uniform(-1, 1);
  const int count = random.integer(2, 6);
  const bool bored = random.chance(0.5);
  for (int i = 0; i < count; ++i) {
    const double middle = s * random.uniform(0.3, 0.5);
    ZPlane plane{z, bored ? middle * random.uniform(0, 0.9) : 0, s * random.uniform(0.55, 1)};
    if (random.chance(0.1)) plane.rmin = plane.rmax = middle;
    if (i > 0 && random.chance(0.3)) {
      plane.rmin = planes.back().rmin;
      plane.rmax = planes.back().rmax;
    }
    planes.push_back(plane);
    if (i + 1 < count && i > 0 && random.chance(0.3)) {
      // A step.
      planes.push_back({z, bored ? s * random.uniform(0.1, 0.29) : 0, s * random.uniform(0.55, 1)});
      if (planes[planes.size() - 2].rmax < planes.back().rmin) planes.pop_back();
    }
    z += s * random.scale(0.02, 2);
  }
  if (std::all_of(planes.begin(), planes.end(),
                  [](const ZPlane& plane) { return plane.rmin == plane.rmax; })) {
    planes.front().rmax *= 2;
  }
  if (random.chance(0.3)) std::reverse(planes.begin(), planes.end());
  return planes;
}

/// Planes whose contour turns back along z.
inline std::vector<ZPlane> turning_planes(double s) {
  // A cup: up along a thin wall, over the rim, and down inside.
  return {{0, 0.9 * s, 1.0 * s},
          {s, 0.8 * s, 1.1 * s},
          {s, 0.5 * s, 0.8 * s},
          {0.2 * s, 0.4 * s, 0.5 * s}};
}

inline SolidCase random_polycone(Random& random) {
  const double s = random.scale(1e-3, 1e4);
  const auto planes = random_planes(random, s);
  const Segment phi = random_segment(random);
  return {make_polycone("polycone", planes, phi.start, phi.delta),
          polycone_distance(planes, phi.start, phi.delta), 4 * s};
}

inline SolidCase random_turning_polycone(Random& random) {
  const double s = random.scale(1e-3, 1e4);
  const auto planes = turning_planes(s);
  const Segment phi = random_segment(random);
  return {make_polycone("polycone", planes, phi.start, phi.delta),
          polycone_distance(planes, phi.start, phi.delta), 3 * s};
}
inline SolidCase random_turning_polyhedra(Random& random) {
  const double s = random.scale(1e-3, 1e4);
  const auto planes = turning_planes(s);
  const Segment phi = random_segment(random);
  return {make_polyhedra("polyhedra", planes, 7, phi.start, phi.delta),
          polyhedra_distance(planes, 7, phi.start, phi.delta), 3 * s};
}

inline SolidCase random_polyhedra(Random& random) {
  const double s = random.scale(1e-3, 1e4);
  const auto planes = random_planes(random, s);
  const Segment phi = random_segment(random);
  const int fewest = phi.delta > 6.2 ? 3 : phi.delta < 3 ? 1 : 3;
  const int sides = random.integer(fewest, 12);
  return {make_polyhedra("polyhedra", planes, sides, phi.start, phi.delta),
          polyhedra_distance(planes, sides, phi.start, phi.delta), 5 * s};
}

/// The makers of random primitives, by name.
struct Maker {
  const char* name;
  SolidCase (*make)(Random&);
};
inline void PrintTo(const Maker& maker, std::ostream* out) { *out << maker.name; }
constexpr Maker primitive_makers[] = {
    {"box", random_box},       {"tube", random_tube},         {"cone", random_cone},
    {"trd", random_trd},       {"trap", random_trap},         {"orb", random_orb},
    {"sphere", random_sphere}, {"polycone", random_polycone}, {"polyhedra", random_polyhedra}};

/// A rotation about a random axis, or none, with a translation.
inline SolidFrame random_frame(Random& random, double size) {
  SolidFrame frame;
  for (double& x : frame.translation) x = size * random.uniform(-0.4, 0.4);
  if (random.chance(0.3)) return frame;
  const Direction u = random.direction();
  const double angle = random.uniform(0, 6), c = std::cos(angle), k = 1 - c, s = std::sin(angle);
  const double r[9] = {c + k * u.x * u.x,       k * u.x * u.y - s * u.z, k * u.x * u.z + s * u.y,
                       k * u.x * u.y + s * u.z, c + k * u.y * u.y,       k * u.y * u.z - s * u.x,
                       k * u.x * u.z - s * u.y, k * u.y * u.z + s * u.x, c + k * u.z * u.z};
  std::copy(std::begin(r), std::end(r), frame.rotation);
  return frame;
}

inline SolidCase placed_case(const SolidCase& c, const SolidFrame& frame) {
  const SignedDistance f = [g = c.distance, frame](const WidePoint& p) {
    const Wide x = p.x - frame.translation[0], y = p.y - frame.translation[1],
               z = p.z - frame.translation[2];
    const double* r = frame.rotation;
    return g({r[0] * x + r[1] * y + r[2] * z, r[3] * x + r[4] * y + r[5] * z,
              r[6] * x + r[7] * y + r[8] * z});
  };
  return {make_placed("placed", c.solid, frame), f, c.size};
}

/// Booleans of booleans of primitives of one size.
inline SolidCase random_boolean(Random& random, double s, int depth) {
  if (depth == 0) {
    switch (random.integer(0, 3)) {
      case 0: {
        std::vector<WidePoint> corners;
        for (int i = 0; i < 8; ++i) {
          corners.push_back({i & 1 ? s : -s, i & 2 ? s / 2 : -s / 2, i & 4 ? s : -s});
        }
        return {make_box("b", s, s / 2, s), hexahedron_distance(corners), 2 * s};
      }
      case 1:
        return {make_tube("t", s / 4, s, s, 0.3, 4),
                polycone_distance({{-s, s / 4, s}, {s, s / 4, s}}, 0.3, 4), 2 * s};
      case 2:
        return {make_cone("c", 0, s, s / 5, s / 4, s, 0, 7),
                polycone_distance({{-s, 0, s}, {s, s / 5, s / 4}}, 0, 7), 2 * s};
      default:
        return {make_orb("o", s), [s](const WidePoint& p) { return std::hypot(p.x, p.y, p.z) - s; },
                2 * s};
    }
  }
  const SolidCase a = random_boolean(random, s, random.integer(0, depth - 1));
  const SolidCase b =
      placed_case(random_boolean(random, s, random.integer(0, depth - 1)), random_frame(random, s));
  const auto f = a.distance, g = b.distance;
  switch (random.integer(0, 2)) {
    case 0:
      return {make_union("u", a.solid, b.solid),
              [f, g](const WidePoint& p) { return std::min(f(p), g(p)); }, a.size + b.size};
    case 1:
      return {make_intersection("i", a.solid, b.solid),
              [f, g](const WidePoint& p) { return std::max(f(p), g(p)); }, a.size + b.size};
    default:
      return {make_subtraction("s", a.solid, b.solid),
              [f, g](const WidePoint& p) { return std::max(f(p), -g(p)); }, a.size + b.size};
  }
}
inline SolidCase random_composite(Random& random) {
  return random_boolean(random, random.scale(1e-3, 1e4), 3);
}

constexpr Maker composite_makers[] = {{"turning_polycone", random_turning_polycone},
                                      {"turning_polyhedra", random_turning_polyhedra},
                                      {"boolean", random_composite}};

}  // namespace navjit::test
