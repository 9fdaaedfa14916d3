#include "analysis/axial_extent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "analysis/axis.hpp"
#include "geometry/solids/solid.hpp"
#include "navjit/vector.hpp"

namespace navjit {
namespace {

constexpr double pi = std::numbers::pi;

/// If the own axis of a solid is inclined by more than this (rad), the solid's box is used instead.
/// Up to this angle, inclination shortens a radius by less than 1e-12 of itself.
constexpr double most_inclined = 1e-6;

struct Planar {
  double x, y;
};

double radius(const Planar& p) { return std::hypot(p.x, p.y); }

std::array<double, 3> components(const Vec3& p) { return {p.x, p.y, p.z}; }

Planar across(const Vec3& p, int axis) {
  const auto c = components(p);
  return {c[static_cast<std::size_t>((axis + 1) % 3)], c[static_cast<std::size_t>((axis + 2) % 3)]};
}

/// The distance from the origin to a segment.
double distance_to_segment(const Planar& a, const Planar& b) {
  const Planar along{b.x - a.x, b.y - a.y};
  const double length2 = along.x * along.x + along.y * along.y;
  const double t =
      length2 > 0 ? std::clamp(-(a.x * along.x + a.y * along.y) / length2, 0.0, 1.0) : 0.0;
  return radius({a.x + t * along.x, a.y + t * along.y});
}

std::array<Vec3, 8> corners(const Extent& e, const Transformation& t) {
  std::array<Vec3, 8> result;
  for (std::size_t i = 0; i < 8; ++i) {
    result[i] = to_outer(t, {(i & 1) != 0 ? e.max.x : e.min.x, (i & 2) != 0 ? e.max.y : e.min.y,
                             (i & 4) != 0 ? e.max.z : e.min.z});
  }
  return result;
}

/// The smallest range that holds all of these azimuths, rad.
struct Span {
  double first, span;
};
Span span_of(std::array<double, 8> azimuths) {
  std::sort(azimuths.begin(), azimuths.end());
  double gap = azimuths[0] + 2 * pi - azimuths[7], first = azimuths[0];
  for (std::size_t i = 1; i < azimuths.size(); ++i) {
    if (azimuths[i] - azimuths[i - 1] > gap) {
      gap = azimuths[i] - azimuths[i - 1];
      first = azimuths[i];
    }
  }
  return {first, 2 * pi - gap};
}
/// Whether a convex body that spans this range may have the origin outside of it. Then it fills
/// less than half a turn.
bool may_be_outside(const Span& span) { return span.span < pi - 1e-6; }

/// The distance from the origin to the convex hull of points, if the origin is outside of the hull.
double nearest(const std::array<Planar, 8>& points) {
  double near = radius(points[0]);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      near = std::min(near, distance_to_segment(points[i], points[j]));
    }
  }
  return near;
}

/// The extent of the box around the solid in the solid's own frame.
AxialExtent by_box(const Solid& solid, const Transformation& t, int axis) {
  AxialExtent result;
  result.low = std::numeric_limits<double>::infinity();
  result.high = -result.low;
  std::array<Planar, 8> points;
  std::array<double, 8> azimuths;
  const std::array<Vec3, 8> box = corners(solid.extent, t);
  for (std::size_t i = 0; i < 8; ++i) {
    points[i] = across(box[i], axis);
    azimuths[i] = std::atan2(points[i].y, points[i].x);
    const double along = components(box[i])[static_cast<std::size_t>(axis)];
    result.low = std::min(result.low, along);
    result.high = std::max(result.high, along);
    result.far = std::max(result.far, radius(points[i]));
  }
  const Span span = span_of(azimuths);
  result.first = span.first;
  if (!may_be_outside(span)) return result;
  result.around = false;
  result.span = span.span;
  result.near = nearest(points);
  return result;
}

/// The largest radius of the circle, as a share of the distance to the daughter. With a larger
/// radius it is hardly known on which tangent a point is.
constexpr double farthest_lean = 0.99;
/// Tangents are used if the daughter spans at most this share of what it spans in radii. A guess.
constexpr double worth_leaning = 0.5;

std::array<Planar, 8> box_across(const Solid& solid, const Transformation& t, int axis) {
  std::array<Planar, 8> points;
  const std::array<Vec3, 8> box = corners(solid.extent, t);
  std::transform(box.begin(), box.end(), points.begin(),
                 [&](const Vec3& corner) { return across(corner, axis); });
  return points;
}

std::optional<TangentSpan> tangents_through(const std::array<Planar, 8>& points, double lean) {
  if (!(std::abs(lean) < farthest_lean * nearest(points))) return {};
  // Along a segment outside of the circle the tangent turns in one sense only. So the extremes are
  // at the ends of segments, and for a convex body at its corners.
  std::array<double, 8> azimuths;
  std::transform(points.begin(), points.end(), azimuths.begin(), [&](const Planar& p) {
    return std::remainder(std::atan2(p.y, p.x) - std::asin(lean / radius(p)), 2 * pi);
  });
  const Span span = span_of(azimuths);
  if (!may_be_outside(span)) return {};
  return TangentSpan{span.first, span.span};
}

/// What SolidFacts says of the solid, if the solid is known to be about its z axis.
std::optional<Round> round_of(const Solid& solid) {
  return kernels::visit(solid.any(), []<class Shape>(const Shape& s) -> std::optional<Round> {
    if constexpr (requires { SolidFacts<Shape>::round(s); }) return SolidFacts<Shape>::round(s);
    return std::nullopt;
  });
}

/// The radius of a ball about the solid's origin that holds the solid, if SolidFacts knows one.
std::optional<double> ball_of(const Solid& solid) {
  return kernels::visit(solid.any(), []<class Shape>(const Shape& s) -> std::optional<double> {
    if constexpr (requires { SolidFacts<Shape>::ball(s); }) return SolidFacts<Shape>::ball(s);
    return std::nullopt;
  });
}

}  // namespace

AxialExtent axial_extent(const Solid& solid, const Transformation& t, int axis) {
  AxialExtent result = by_box(solid, t, axis);
  const std::optional<Round> known = round_of(solid);
  if (!known) return result;
  const Round& round = *known;
  // The solid's own axis in the mother's frame: a row of the rotation.
  const double* r = t.rotation;
  const Vec3 own{r[6], r[7], r[8]};
  const double inclined = radius(across(own, axis));
  if (inclined > most_inclined) return result;
  const double height = std::max(std::abs(solid.extent.min.z), std::abs(solid.extent.max.z));
  const Vec3 at{t.translation[0], t.translation[1], t.translation[2]};
  const double off = radius(across(at, axis)) + inclined * height;
  result.near = std::max(result.near, round.near * (1 - 1e-12) - off);
  result.far = std::min(result.far, round.far + off);
  if (round.wedge.kind == 0 || off > 1e-10 * round.far) return result;
  // The edges of the segment. Seen against the solid's own axis they are exchanged.
  const auto azimuth = [&](double x, double y) {
    const Planar edge =
        across({r[0] * x + r[3] * y, r[1] * x + r[4] * y, r[2] * x + r[5] * y}, axis);
    return std::atan2(edge.y, edge.x);
  };
  const bool upright = components(own)[static_cast<std::size_t>(axis)] > 0;
  const double start = azimuth(round.wedge.start_x, round.wedge.start_y);
  const double end = azimuth(round.wedge.end_x, round.wedge.end_y);
  const double first = upright ? start : end;
  double span = upright ? end - start : start - end;
  if (span < 0) span += 2 * pi;
  if (!result.around && result.span <= span) return result;
  result.around = false;
  result.first = first;
  result.span = span;
  result.segment = true;
  return result;
}

std::optional<TangentSpan> tangent_span(const Solid& solid, const Transformation& t, int axis,
                                        double lean) {
  return tangents_through(box_across(solid, t, axis), lean);
}

double lean_of(const Solid& solid, const Transformation& t, int axis) {
  const std::array<Planar, 8> points = box_across(solid, t, axis);
  const auto by_radii = tangents_through(points, 0);
  if (!by_radii) return 0;
  const Planar middle{0.5 * (points[0].x + points[7].x), 0.5 * (points[0].y + points[7].y)};
  double best = 0, least = worth_leaning * by_radii->span;
  for (const std::size_t end : {1U, 2U, 4U}) {  // of the box's edges from its first corner
    const Planar edge{points[end].x - points[0].x, points[end].y - points[0].y};
    const double length = radius(edge);
    if (!(length > 0)) continue;
    const double outwards = edge.x * middle.x + edge.y * middle.y < 0 ? -1 : 1;
    const double lean = outwards * (edge.x * middle.y - edge.y * middle.x) / length;
    const auto span = tangents_through(points, lean);
    if (!span || !(span->span < least)) continue;
    least = span->span;
    best = lean;
  }
  return best;
}

AxialExtent central_extent(const Solid& solid, const Transformation& t) {
  AxialExtent result;
  for (const Vec3& corner : corners(solid.extent, t)) {
    result.far = std::max(result.far, norm(corner));
  }
  const Vec3 at{t.translation[0], t.translation[1], t.translation[2]};
  if (const std::optional<double> ball = ball_of(solid)) {
    result.far = std::min(result.far, norm(at) + *ball);
  }
  result.near = safety_to_in(solid.any(), to_local(t, Vec3{0, 0, 0}));
  return result;
}

}  // namespace navjit
