// Extruded solids: one polygon, moved and scaled along z.
#include <algorithm>
#include <cstdio>

#include "geometry/solids/bodies.hpp"
#include "geometry/solids/windings.hpp"

namespace navjit {
namespace {

using detail::require;
using detail::wrongly_surrounded;
using Polygon = std::vector<PlanarPoint>;

double turn(const PlanarPoint& a, const PlanarPoint& b, const PlanarPoint& c) {
  return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}
double twice_area(const Polygon& polygon) {
  double sum = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += (polygon[i - 1].x - polygon[0].x) * (polygon[i].y - polygon[0].y) -
           (polygon[i - 1].y - polygon[0].y) * (polygon[i].x - polygon[0].x);
  }
  return sum;
}

/// The polygon anticlockwise, without corners that are on the line between their neighbours.
Polygon cleaned(std::span<const PlanarPoint> given, const std::string& name) {
  require(given.size() >= 3, name, "its polygon has less than three corners");
  Polygon polygon(given.begin(), given.end());
  double size = 0;
  for (const PlanarPoint& p : polygon) {
    detail::require_finite({p.x, p.y}, name);
    size = std::max({size, std::abs(p.x - polygon[0].x), std::abs(p.y - polygon[0].y)});
  }
  const double slight = 1e-10 * size;
  for (bool removed = true; removed && polygon.size() >= 3;) {
    removed = false;
    for (std::size_t i = 0; i < polygon.size() && polygon.size() >= 3; ++i) {
      const std::size_t n = polygon.size();
      const PlanarPoint &a = polygon[(i + n - 1) % n], &b = polygon[i], &c = polygon[(i + 1) % n];
      const double base = std::hypot(c.x - a.x, c.y - a.y);
      if (std::hypot(b.x - a.x, b.y - a.y) <= slight || std::abs(turn(a, b, c)) <= slight * base ||
          base <= slight) {
        polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i));
        removed = true;
      }
    }
  }
  require(polygon.size() >= 3, name, "its polygon has no area");
  if (twice_area(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

bool crosses(const PlanarPoint& a, const PlanarPoint& b, const PlanarPoint& c,
             const PlanarPoint& d) {
  // Edges on one line, apart from one another, may seem to cross because of rounding.
  const auto apart = [](double p, double q, double r, double s) {
    return std::max(p, q) < std::min(r, s) || std::max(r, s) < std::min(p, q);
  };
  if (apart(a.x, b.x, c.x, d.x) || apart(a.y, b.y, c.y, d.y)) return false;
  const auto side = [](const PlanarPoint& p, const PlanarPoint& q, const PlanarPoint& r) {
    const double area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    return area > 0 ? 1 : area < 0 ? -1 : 0;
  };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}
bool crosses_itself(const Polygon& polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = i + 1; k < n; ++k) {
      if (crosses(polygon[i], polygon[(i + 1) % n], polygon[k], polygon[(k + 1) % n])) return true;
    }
  }
  return false;
}

bool convex(const Polygon& polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (turn(polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n]) < 0) return false;
  }
  // The polygon runs around once only.
  int upwards = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool before = polygon[(i + n - 1) % n].y < polygon[i].y;
    const bool after = polygon[i].y < polygon[(i + 1) % n].y;
    if (!before && after) ++upwards;
  }
  return upwards <= 1;
}

/// Triangulates by cutting off one ear after the other. Empty if at some time there is no ear,
/// since the polygon touches or crosses itself.
std::vector<kernels::Facet> ears(const Polygon& polygon) {
  std::vector<int> left;
  left.reserve(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) left.push_back(static_cast<int>(i));
  const auto at = [&](int i) -> const PlanarPoint& { return polygon[static_cast<std::size_t>(i)]; };
  std::vector<kernels::Facet> made;
  while (left.size() > 3) {
    const std::size_t n = left.size();
    std::size_t ear = n;
    double fattest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const int ia = left[(i + n - 1) % n], ib = left[i], ic = left[(i + 1) % n];
      const PlanarPoint &a = at(ia), &b = at(ib), &c = at(ic);
      const double area = turn(a, b, c);
      if (!(area > 0)) continue;
      // Long thin ears come last.
      const double longest =
          std::max({std::hypot(b.x - a.x, b.y - a.y), std::hypot(c.x - b.x, c.y - b.y),
                    std::hypot(a.x - c.x, a.y - c.y)});
      const double fat = area / (longest * longest);
      if (fat <= fattest) continue;
      const bool empty = std::none_of(left.begin(), left.end(), [&](int k) {
        if (k == ia || k == ib || k == ic) return false;
        const PlanarPoint& p = at(k);
        if ((p.x == a.x && p.y == a.y) || (p.x == b.x && p.y == b.y) || (p.x == c.x && p.y == c.y))
          return false;
        return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
      });
      if (!empty) continue;
      ear = i;
      fattest = fat;
    }
    if (ear == n) return {};
    made.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  made.push_back({left[0], left[1], left[2]});
  return made;
}

/// Triangles from one corner, whatever lies between. What is covered twice has opposite signs, so
/// that they wind around each point as often as the polygon does.
std::vector<kernels::Facet> fan(const Polygon& polygon) {
  std::vector<kernels::Facet> made;
  for (int i = 1; i + 1 < static_cast<int>(polygon.size()); ++i) made.push_back({0, i, i + 1});
  return made;
}

/// Triangles that cover the polygon. Throws if it crosses itself by more than slightly.
std::vector<kernels::Facet> triangles(const Polygon& polygon, bool crossing,
                                      const std::string& name, std::string* note) {
  if (!crossing) {
    std::vector<kernels::Facet> cut = ears(polygon);
    if (!cut.empty()) return cut;
  }
  const double part = wrongly_surrounded(polygon) / (twice_area(polygon) / 2);
  char text[200];
  if (!(part <= 1e-4)) {
    std::snprintf(
        text, sizeof text,
        "': its polygon crosses itself, and surrounds %.2g of its area twice or the wrong way "
        "round; correct its corners",
        part);
    throw GeometryError("solid '" + name + text);
  }
  if (note != nullptr) {
    std::snprintf(text, sizeof text, "surrounds %.2g of its area twice or the wrong way round",
                  part);
    *note = text;
  }
  return fan(polygon);
}

}  // namespace

Solid make_extruded(std::string name, std::span<const PlanarPoint> given,
                    std::span<const ExtrudedSection> sections, std::string* note) {
  const Polygon polygon = cleaned(given, name);
  require(polygon.size() <= 5000, name, "its polygon has more than 5000 corners");
  const bool crossing = crosses_itself(polygon);
  require(sections.size() >= 2, name, "it has less than two sections");
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const ExtrudedSection& s = sections[i];
    detail::require_finite({s.z, s.x, s.y, s.scale}, name);
    require(s.scale > 0, name, "the scale of a section must be positive");
    require(i == 0 || s.z > sections[i - 1].z, name, "its sections must ascend in z");
    for (const PlanarPoint& p : polygon) {
      corners.push_back({s.scale * p.x + s.x, s.scale * p.y + s.y, s.z});
    }
  }
  const int n = static_cast<int>(polygon.size()), last = static_cast<int>(sections.size()) - 1;
  const auto corner = [&](int section, int i) {
    return corners[static_cast<std::size_t>(section) * polygon.size() +
                   static_cast<std::size_t>(i % n)];
  };
  if (sections.size() == 2 && !crossing && convex(polygon)) {
    Extent e{corners[0], corners[0]};
    for (const Vec3& p : corners) e = merged(e, {p, p});
    std::vector<kernels::Plane<double>> planes{{0, 0, -1, sections[0].z},
                                               {0, 0, 1, -sections[1].z}};
    for (int i = 0; i < n; ++i) {
      // The larger end fixes the plane most accurately.
      const bool top = sections[1].scale > sections[0].scale;
      planes.push_back(top ? detail::plane_through(corner(1, i), corner(0, i), corner(1, i + 1))
                           : detail::plane_through(corner(0, i), corner(0, i + 1), corner(1, i)));
    }
    return detail::make_hull(std::move(name), std::move(planes), e);
  }
  const bool upright = std::all_of(sections.begin(), sections.end(), [&](const ExtrudedSection& s) {
    return s.scale == sections[0].scale && s.x == sections[0].x && s.y == sections[0].y;
  });
  // The polygon may touch itself, but may surround nothing twice or the wrong way round.
  if (upright && !crossing && polygon.size() <= kernels::most_corners_of_prism &&
      wrongly_surrounded(polygon) <= 1e-12 * twice_area(polygon)) {
    return detail::make_prism(std::move(name), std::span(corners).first(polygon.size()),
                              sections.front().z, sections.back().z);
  }
  std::vector<kernels::Facet> facets;
  for (const kernels::Facet& f : triangles(polygon, crossing, name, note)) {
    facets.push_back({f.a, f.c, f.b});
    facets.push_back({last * n + f.a, last * n + f.b, last * n + f.c});
  }
  for (int k = 0; k < last; ++k) {
    for (int i = 0; i < n; ++i) {
      const int a = k * n + i, b = k * n + (i + 1) % n;
      facets.push_back({a, b, b + n});
      facets.push_back({a, b + n, a + n});
    }
  }
  return detail::make_facets(std::move(name), std::move(corners), std::move(facets), nullptr);
}

}  // namespace navjit
