#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "geometry/solids/bodies.hpp"

namespace navjit {
namespace {

using detail::require;

double cross(const PlanarPoint& a, const PlanarPoint& b) { return a.x * b.y - a.y * b.x; }
double dot(const PlanarPoint& a, const PlanarPoint& b) { return a.x * b.x + a.y * b.y; }
PlanarPoint minus(const PlanarPoint& a, const PlanarPoint& b) { return {a.x - b.x, a.y - b.y}; }
double length(const PlanarPoint& a) { return std::hypot(a.x, a.y); }

/// The side between the lines from a to c and from b to d; the solid is to the left of a..b.
struct SideCorners {
  PlanarPoint a, b, c, d;

  double longest() const { return std::max(length(minus(b, a)), length(minus(d, c))); }
  bool flat(double slight) const {
    const PlanarPoint low = minus(b, a), high = minus(d, c);
    return std::min(length(low), length(high)) <= slight ||
           std::abs(cross(low, high)) <= slight * longest();
  }
};

kernels::Plane<double> flat_side(const SideCorners& s, double hz) {
  // These are the diagonals: they exist also if one edge has no length.
  const Vec3 u{s.d.x - s.a.x, s.d.y - s.a.y, 2 * hz}, w{s.c.x - s.b.x, s.c.y - s.b.y, 2 * hz};
  Vec3 n{u.y * w.z - u.z * w.y, u.z * w.x - u.x * w.z, u.x * w.y - u.y * w.x};
  const double norm = std::hypot(n.x, n.y, n.z);
  for (double* component : {&n.x, &n.y, &n.z}) {
    *component = std::abs(*component) < 1e-15 * norm ? 0 : *component / norm;
  }
  return {n.x, n.y, n.z,
          -(n.x * (s.a.x + s.b.x + s.c.x + s.d.x) + n.y * (s.a.y + s.b.y + s.c.y + s.d.y)) / 4};
}

/// With u = z / hz the edge at z starts at A + u A' and runs along E + u E'. A point is behind it
/// where the product of E + u E' and (x, y) - A - u A' is positive.
kernels::TwistedFace<double> twisted_side(const SideCorners& s, double hz) {
  const PlanarPoint a{(s.a.x + s.c.x) / 2, (s.a.y + s.c.y) / 2};
  const PlanarPoint da{(s.c.x - s.a.x) / (2 * hz), (s.c.y - s.a.y) / (2 * hz)};
  const PlanarPoint low = minus(s.b, s.a), high = minus(s.d, s.c);
  const PlanarPoint e{(low.x + high.x) / 2, (low.y + high.y) / 2};
  const PlanarPoint de{(high.x - low.x) / (2 * hz), (high.y - low.y) / (2 * hz)};
  const double k = 1 / length(e);
  return {de.y * k, -de.x * k, cross(de, da) * k, (cross(e, da) + cross(de, a)) * k,
          e.y * k,  -e.x * k,  cross(e, a) * k};
}

/// The plane that a side is near, and how near (SidePlanes), within |x| <= far.x and so on.
struct NearPlane {
  kernels::Plane<double> plane;
  double reach, lean;
};

constexpr double unknown = std::numeric_limits<double>::infinity();

/// The edge at z runs along E (1 + grows z) + turned(E) turns z, and its middle along C + z C', so
/// that the side is where (1 + grows z) L + turns z M = 0: L is how far a point is beside the line
/// through that middle along E, which makes a plane, and M how far it is along it.
NearPlane plane_near(const SideCorners& s, double hz, const Vec3& far) {
  const PlanarPoint low = minus(s.b, s.a), high = minus(s.d, s.c);
  const double twice = length({low.x + high.x, low.y + high.y});
  const PlanarPoint along{(low.x + high.x) / twice, (low.y + high.y) / twice};
  const PlanarPoint change{(high.x - low.x) / (hz * twice), (high.y - low.y) / (hz * twice)};
  const double grows = dot(along, change), turns = cross(along, change);
  const PlanarPoint middle{(s.a.x + s.b.x + s.c.x + s.d.x) / 4,
                           (s.a.y + s.b.y + s.c.y + s.d.y) / 4};
  const PlanarPoint drift{(s.c.x + s.d.x - s.a.x - s.b.x) / (4 * hz),
                          (s.c.y + s.d.y - s.a.y - s.b.y) / (4 * hz)};
  const double steepness = std::hypot(1, cross(along, drift));
  const double most_along = std::abs(along.x) * far.x + std::abs(along.y) * far.y +
                            std::abs(dot(along, middle)) + std::abs(dot(along, drift)) * far.z;
  const double least_growth = 1 - std::abs(grows) * far.z;
  if (!(least_growth > 0)) return {{}, unknown, unknown};
  const double twist = std::abs(turns) / (least_growth * steepness);
  return {{along.y / steepness, -along.x / steepness, cross(along, drift) / steepness,
           cross(along, middle) / steepness},
          twist * far.z * most_along,
          twist * (most_along * (1 + far.z * std::abs(grows) / least_growth) +
                   far.z * std::hypot(1, dot(along, drift)))};
}

/// With room for rounding, both here and where planes are asked. The plane is made useless if the
/// side twists too much, or if the solid may be no larger than the tolerance.
NearPlane made_safe(NearPlane near, const Vec3& far) {
  const double size = far.x + far.y + far.z;
  near.lean += 0x1p-40;
  near.reach += 0x1p-20 * near.reach + 0x1p-43 * size;
  constexpr double most_lean = 1.0 / 4, most_reach = 1.0 / 32, least_size = 1e-6;
  if (!(near.lean <= most_lean && near.reach <= most_reach * size &&
        std::min({far.x, far.y, far.z}) >= least_size)) {
    near.reach = near.lean = unknown;
  }
  return near;
}

kernels::SidePlanes<double> planes_near(std::span<const NearPlane, 4> n) {
  const auto four = [&](auto&& number) {
    return kernels::FourOf<double>{number(n[0]), number(n[1]), number(n[2]), number(n[3])};
  };
  return {four([](const NearPlane& s) { return s.plane.a; }),
          four([](const NearPlane& s) { return s.plane.b; }),
          four([](const NearPlane& s) { return s.plane.c; }),
          four([](const NearPlane& s) { return s.plane.d; }),
          four([](const NearPlane& s) { return s.reach; }),
          four([](const NearPlane& s) { return s.lean; })};
}

}  // namespace

Solid make_arb8(std::string name, double hz, std::span<const PlanarPoint, 8> given) {
  require(std::isfinite(hz) && hz > 0, name, "an arb8 needs a positive length");
  PlanarPoint p[8];
  std::copy(given.begin(), given.end(), p);
  Extent e{{p[0].x, p[0].y, -hz}, {p[0].x, p[0].y, hz}};
  for (const PlanarPoint& q : p) {
    detail::require_finite({q.x, q.y}, name);
    e = merged(e, {{q.x, q.y, -hz}, {q.x, q.y, hz}});
  }
  const double size = std::max(e.max.x - e.min.x, e.max.y - e.min.y);
  const auto twice_area = [&](int i) {
    return cross(minus(p[i + 2], p[i]), minus(p[i + 3], p[i + 1]));
  };
  const double low = twice_area(0), high = twice_area(4), slight = 1e-9 * size;
  require(std::max(std::abs(low), std::abs(high)) > slight * size, name, "an arb8 has no volume");
  require(!((low > slight * size && high < -slight * size) ||
            (low < -slight * size && high > slight * size)),
          name, "the corners of an arb8 run opposite ways round at its ends");
  if (low + high < 0) {
    std::swap(p[1], p[3]);
    std::swap(p[5], p[7]);
  }
  std::vector<SideCorners> sides;
  for (int i = 0; i < 4; ++i) {
    const int k = (i + 1) % 4, l = (i + 2) % 4;
    for (const int end : {0, 4}) {
      const PlanarPoint here = minus(p[k + end], p[i + end]), next = minus(p[l + end], p[k + end]);
      require(cross(here, next) >= -slight * size, name, "the ends of an arb8 must be convex");
    }
    const SideCorners side{p[i], p[k], p[i + 4], p[k + 4]};
    if (side.longest() <= slight) continue;  // nothing between two lines that coincide
    const PlanarPoint bottom = minus(side.b, side.a), top = minus(side.d, side.c);
    require(dot(bottom, top) >= -slight * side.longest(), name,
            "a side of an arb8 twists by more than 90 degrees");
    sides.push_back(side);
  }
  require(sides.size() >= 3, name, "an arb8 has no volume");
  if (std::all_of(sides.begin(), sides.end(),
                  [&](const SideCorners& s) { return s.flat(slight); })) {
    std::vector<kernels::Plane<double>> planes{{0, 0, -1, -hz}, {0, 0, 1, -hz}};
    for (const SideCorners& side : sides) planes.push_back(flat_side(side, hz));
    return detail::make_hull(std::move(name), std::move(planes), e);
  }
  kernels::TwistedFace<double> faces[4];
  NearPlane planes[4];
  const double hx = std::max(std::abs(e.min.x), std::abs(e.max.x));
  const double hy = std::max(std::abs(e.min.y), std::abs(e.max.y));
  constexpr double room = 1 + 1.0 / 32;
  const Vec3 far{room * hx, room * hy, room * hz};
  for (std::size_t i = 0; i < 4; ++i) {
    const SideCorners& side = sides[std::min(i, sides.size() - 1)];
    if (side.flat(slight)) {
      const kernels::Plane<double> f = flat_side(side, hz);
      faces[i] = {0, 0, 0, f.c, f.a, f.b, f.d};
      planes[i] = made_safe({f, 0, 0}, far);
    } else {
      faces[i] = twisted_side(side, hz);
      planes[i] = made_safe(plane_near(side, hz, far), far);
    }
  }
  const kernels::Arb8<double> shape{hz,       hx,       hy,       faces[0],
                                    faces[1], faces[2], faces[3], planes_near(planes)};
  return detail::make_solid(std::move(name), SolidKind::arb8, shape, e);
}

/// The integral over z of the section's area, from the lines along which the corners run.
double SolidFacts<kernels::Arb8<double>>::volume(const Shape& s) {
  const kernels::TwistedFace<double>* faces[] = {&s.first, &s.second, &s.third, &s.fourth};
  // The corners are where two neighbouring sides meet; the area is quadratic in z.
  const auto area_at = [&](double z) {
    double x[4], y[4];
    int corners = 0;
    for (int i = 0; i < 4; ++i) {
      const auto &f = *faces[i], &g = *faces[(i + 1) % 4];
      const double fa = f.a * z + f.e, fb = f.b * z + f.f, fc = (f.c * z + f.d) * z + f.g;
      const double ga = g.a * z + g.e, gb = g.b * z + g.f, gc = (g.c * z + g.d) * z + g.g;
      const double det = fa * gb - fb * ga;
      if (std::abs(det) < 1e-12 * std::hypot(fa, fb) * std::hypot(ga, gb)) continue;
      x[corners] = (fb * gc - fc * gb) / det;
      y[corners++] = (fc * ga - fa * gc) / det;
    }
    double twice = 0;
    for (int i = 2; i < corners; ++i) {
      twice += (x[i - 1] - x[0]) * (y[i] - y[0]) - (y[i - 1] - y[0]) * (x[i] - x[0]);
    }
    return std::abs(twice) / 2;
  };
  // Gauss's three points are not at the ends, where a side may have no length.
  const double far = s.hz * std::sqrt(0.6);
  return s.hz / 9 * (5 * area_at(-far) + 8 * area_at(0) + 5 * area_at(far));
}

}  // namespace navjit
