#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/solids/bodies.hpp"

namespace navjit {
namespace {

using Plane = kernels::Plane<double>;

using Group = kernels::PlaneGroup<double>;

struct Holder {
  std::vector<Plane> planes;
  std::vector<Group> groups;
  kernels::Hull<double> shape;
};

std::vector<Group> by_eight(const std::vector<Plane>& planes) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < planes.size(); i += 8) {
    const auto eight = [&](double Plane::*coefficient) {
      return detail::eight_from(i, planes.size(),
                                [&](std::size_t k) { return planes[k].*coefficient; });
    };
    groups.push_back({eight(&Plane::a), eight(&Plane::b), eight(&Plane::c), eight(&Plane::d)});
  }
  return groups;
}

double distance(const Plane& f, const Vec3& p) { return kernels::plane_distance(f, p); }

/// A square on the plane, around the point of the plane that is nearest to `centre`.
std::vector<Vec3> square_on(const Plane& f, const Vec3& centre, double half) {
  const double off = distance(f, centre);
  const Vec3 o{centre.x - off * f.a, centre.y - off * f.b, centre.z - off * f.c};
  // Any direction across the normal, made from the axis that is least along it.
  const double x = std::abs(f.a), y = std::abs(f.b), z = std::abs(f.c);
  const Vec3 axis = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  Vec3 u{f.b * axis.z - f.c * axis.y, f.c * axis.x - f.a * axis.z, f.a * axis.y - f.b * axis.x};
  const double k = half / std::hypot(u.x, u.y, u.z);
  u = {k * u.x, k * u.y, k * u.z};
  const Vec3 w{f.b * u.z - f.c * u.y, f.c * u.x - f.a * u.z, f.a * u.y - f.b * u.x};
  return {{o.x + u.x + w.x, o.y + u.y + w.y, o.z + u.z + w.z},
          {o.x - u.x + w.x, o.y - u.y + w.y, o.z - u.z + w.z},
          {o.x - u.x - w.x, o.y - u.y - w.y, o.z - u.z - w.z},
          {o.x + u.x - w.x, o.y + u.y - w.y, o.z + u.z - w.z}};
}

/// The part of a polygon that lies behind a plane.
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const Plane& f) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at_p = distance(f, p), at_q = distance(f, q);
    if (at_p <= 0) kept.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
      const double k = at_p / (at_p - at_q);
      kept.push_back({p.x + k * (q.x - p.x), p.y + k * (q.y - p.y), p.z + k * (q.z - p.z)});
    }
  }
  return kept;
}

/// The volume of the pyramids from `apex` over all faces, and how far the body reaches from there.
struct Measure {
  double volume, reach;
};
/// No point of the body may be further than `reach` from the apex. The closer this bound, the more
/// accurate the volume.
Measure measure(const std::vector<Plane>& planes, const Vec3& apex, double reach) {
  Measure m{0, 0};
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const Plane& face = planes[i];
    std::vector<Vec3> polygon = square_on(face, apex, reach);
    for (std::size_t k = 0; k < planes.size() && !polygon.empty(); ++k) {
      if (k != i) polygon = clipped(polygon, planes[k]);
    }
    for (const Vec3& p : polygon) {
      m.reach = std::max(m.reach, std::hypot(p.x - apex.x, p.y - apex.y, p.z - apex.z));
    }
    double twice_area = 0;
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      const Vec3 u = kernels::difference(polygon[k - 1], polygon[0]);
      const Vec3 w = kernels::difference(polygon[k], polygon[0]);
      twice_area += std::hypot(u.y * w.z - u.z * w.y, u.z * w.x - u.x * w.z, u.x * w.y - u.y * w.x);
    }
    m.volume -= twice_area / 6 * distance(face, apex);
  }
  return m;
}

/// Each plane once: half a turn begins and ends in the same plane.
std::vector<Plane> without_equals(const std::vector<Plane>& planes) {
  std::vector<Plane> kept;
  for (const Plane& f : planes) {
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Plane& g) {
      return std::abs(f.a - g.a) + std::abs(f.b - g.b) + std::abs(f.c - g.c) < 1e-12 &&
             std::abs(f.d - g.d) <= 1e-12 * (std::abs(f.d) + std::abs(g.d)) + 1e-12;
    });
    if (!known) kept.push_back(f);
  }
  return kept;
}

/// Where three planes meet; nothing if they are parallel to a line.
std::optional<Vec3> meeting_of(const Plane& f, const Plane& g, const Plane& h) {
  const Vec3 a{f.a, f.b, f.c}, b{g.a, g.b, g.c}, c{h.a, h.b, h.c};
  const Vec3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const double det = dot(a, bc);
  if (!(std::abs(det) > 0)) return std::nullopt;
  const Vec3 p = (-1 / det) * (f.d * bc + g.d * ca + h.d * ab);
  if (!std::isfinite(p.x + p.y + p.z)) return std::nullopt;
  return p;
}

/// The volume within four planes, from the corners where three of them meet.
double tetrahedron(const std::vector<Plane>& f) {
  const std::optional<Vec3> corners[] = {meeting_of(f[1], f[2], f[3]), meeting_of(f[0], f[2], f[3]),
                                         meeting_of(f[0], f[1], f[3]),
                                         meeting_of(f[0], f[1], f[2])};
  for (const std::optional<Vec3>& corner : corners) {
    if (!corner) return 0;  // without a volume, or without an end
  }
  const Vec3 u = *corners[1] - *corners[0], v = *corners[2] - *corners[0],
             w = *corners[3] - *corners[0];
  return std::abs(dot(u, cross(v, w))) / 6;
}

/// The corners of a body with few faces, which may be flat: nearly parallel faces say little about
/// how far it reaches.
std::vector<Vec3> corners_of(const std::vector<Plane>& planes) {
  std::vector<Vec3> corners;
  constexpr std::size_t most_faces = 16;
  if (planes.size() > most_faces) return corners;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const std::optional<Vec3> p = meeting_of(planes[i], planes[j], planes[k]);
        if (!p) continue;
        const double rounding = 1e-12 + 1e-9 * norm(*p);
        const bool holds = std::all_of(planes.begin(), planes.end(),
                                       [&](const Plane& f) { return distance(f, *p) <= rounding; });
        if (holds) corners.push_back(*p);
      }
    }
  }
  return corners;
}

}  // namespace

namespace detail {

kernels::Plane<double> plane_through(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = kernels::difference(b, a), w = kernels::difference(c, a);
  Vec3 n{u.y * w.z - u.z * w.y, u.z * w.x - u.x * w.z, u.x * w.y - u.y * w.x};
  const double norm = std::hypot(n.x, n.y, n.z);
  if (!(norm > 0)) return {0, 0, 0, 0};
  for (double* component : {&n.x, &n.y, &n.z}) {
    *component = std::abs(*component) < 1e-15 * norm ? 0 : *component / norm;
  }
  return {n.x, n.y, n.z, -(n.x * a.x + n.y * a.y + n.z * a.z)};
}

Solid make_hull(std::string name, std::vector<Plane> planes, const Extent& extent) {
  std::vector<Group> groups = by_eight(planes);
  const auto holder = std::make_shared<Holder>(Holder{std::move(planes), std::move(groups), {}});
  holder->shape = {holder->planes.data(), static_cast<int>(holder->planes.size()),
                   holder->groups.data(), static_cast<int>(holder->groups.size())};
  return {std::move(name), SolidKind::hull, std::shared_ptr<const void>(holder, &holder->shape),
          extent};
}

}  // namespace detail

double SolidFacts<kernels::Hull<double>>::volume(const Shape& s) {
  const std::vector<Plane> planes = without_equals({s.planes, s.planes + s.count});
  if (planes.size() == 4) return tetrahedron(planes);
  if (const std::vector<Vec3> corners = corners_of(planes); corners.size() > 3) {
    Vec3 middle{0, 0, 0};
    for (const Vec3& p : corners) middle += (1.0 / static_cast<double>(corners.size())) * p;
    double reach = 0;
    for (const Vec3& p : corners) reach = std::max(reach, norm(p - middle));
    return measure(planes, middle, 1.01 * reach).volume;
  }
  // The planes' distances from the origin are a good enough bound for any reasonable body.
  double reach = 0;
  for (const Plane& f : planes) reach = std::max(reach, std::abs(f.d));
  Vec3 apex{0, 0, 0};
  // Moves the apex towards the inside, so that the pyramids do not cancel.
  for (int turn = 0; turn < 64; ++turn) {
    const auto most = std::max_element(
        planes.begin(), planes.end(),
        [&](const Plane& a, const Plane& b) { return distance(a, apex) < distance(b, apex); });
    const double off = distance(*most, apex);
    if (off <= 0) break;
    apex = {apex.x - off * most->a, apex.y - off * most->b, apex.z - off * most->c};
  }
  const double closer = measure(planes, apex, 1e3 * reach).reach;
  return measure(planes, apex, 2 * closer).volume;
}

std::optional<double> SolidFacts<kernels::Hull<double>>::error(const Shape& s,
                                                               const KernelUse& use) {
  double error = 0;
  for (int i = 0; i < s.count; ++i) error = std::max(error, face_error::plane(s.planes[i].d, use));
  return error;
}

}  // namespace navjit
