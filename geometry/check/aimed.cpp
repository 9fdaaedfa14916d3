#include "geometry/check/aimed.hpp"

#include <algorithm>

#include "geometry/check/chords.hpp"
#include "geometry/model/random.hpp"
#include "navjit/vector.hpp"

namespace navjit {
namespace {

Extent shared(const Extent& a, const Extent& b) {
  return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y), std::max(a.min.z, b.min.z)},
          {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y), std::min(a.max.z, b.max.z)}};
}
double least_side(const Extent& e) {
  return std::min({e.max.x - e.min.x, e.max.y - e.min.y, e.max.z - e.min.z});
}

/// The box of `b` in the frame of `a`.
Extent box_in_frame_of(const PlacedSolid& a, const PlacedSolid& b) {
  const Extent& e = b.solid.extent;
  Extent box{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner{(i & 1) != 0 ? e.max.x : e.min.x, (i & 2) != 0 ? e.max.y : e.min.y,
                      (i & 4) != 0 ? e.max.z : e.min.z};
    const Vec3 q = to_local(a.transformation, to_outer(b.transformation, corner));
    box.min = {std::min(box.min.x, q.x), std::min(box.min.y, q.y), std::min(box.min.z, q.z)};
    box.max = {std::max(box.max.x, q.x), std::max(box.max.y, q.y), std::max(box.max.z, q.z)};
  }
  return box;
}

/// The parts within one of the solids of a line in the mother's frame.
std::vector<Chord> chords_of(const PlacedSolid& s, const Vec3& p, const Vec3& v, double reach,
                             double rounding) {
  const Direction d = to_local(s.transformation, kernels::make_direction(v.x, v.y, v.z));
  return chords_along(s.solid.any(), to_local(s.transformation, p), {d.x, d.y, d.z}, reach,
                      rounding);
}
/// How deep a point of the mother's frame is in the solid; negative if not by the tolerance.
double depth_in(const PlacedSolid& s, const Vec3& p, double tolerance) {
  const Vec3 q = to_local(s.transformation, p);
  if (inside(s.solid.any(), q, tolerance) != Side::inside) return -1;
  return std::max(tolerance, safety_to_out(s.solid.any(), q));
}

/// A point and a unit vector, in the mother's frame.
struct Line {
  Vec3 p, v;
};

/// The line through two random points of a box that is placed by this frame; it starts so far
/// before them. Nothing if they are the same point.
std::optional<Line> line_through(std::mt19937_64& random, const Transformation& frame,
                                 const Extent& box, double before) {
  const auto point = [&] {
    const double x = uniform(random, box.min.x, box.max.x);
    const double y = uniform(random, box.min.y, box.max.y);
    return to_outer(frame, {x, y, uniform(random, box.min.z, box.max.z)});
  };
  const Vec3 p = point();
  Vec3 v = point() - p;
  if (!(norm(v) > 0)) return std::nullopt;
  v = (1 / norm(v)) * v;
  v = (1 / norm(v)) * v;
  return Line{p + (-before) * v, v};
}

}  // namespace

bool boxes_meet(const PlacedSolid& a, const PlacedSolid& b, double tolerance) {
  return least_side(shared(a.solid.extent, box_in_frame_of(a, b))) > tolerance &&
         least_side(shared(b.solid.extent, box_in_frame_of(b, a))) > tolerance;
}

std::optional<SharedPoint> find_shared_point(const PlacedSolid& a, const PlacedSolid& b,
                                             std::size_t lines, double tolerance, double rounding,
                                             std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::optional<SharedPoint> deepest;
  const double reach = 2 * (norm(a.solid.extent.max - a.solid.extent.min) +
                            norm(b.solid.extent.max - b.solid.extent.min)) +
                       rounding;
  for (std::size_t i = 0; i < lines; ++i) {
    const bool first = i % 2 == 0;
    const PlacedSolid &from = first ? a : b, &other = first ? b : a;
    const Extent box = shared(from.solid.extent, box_in_frame_of(from, other));
    const std::optional<Line> line = line_through(random, from.transformation, box, reach);
    if (!line) continue;
    const auto& [start, v] = *line;
    const auto in_b = chords_of(b, start, v, 2 * reach, rounding);
    for (const Chord& c : chords_of(a, start, v, 2 * reach, rounding)) {
      for (const Chord& other_chord : in_b) {
        const double enter = std::max(c.enter, other_chord.enter);
        const double leave = std::min(c.leave, other_chord.leave);
        if (!(leave - enter > tolerance)) continue;
        const Vec3 middle = start + 0.5 * (enter + leave) * v;
        const double depth_a = depth_in(a, middle, tolerance);
        const double depth_b = depth_in(b, middle, tolerance);
        if (depth_a < 0 || depth_b < 0) continue;
        if (!deepest || depth_a + depth_b > deepest->depth) deepest = {middle, depth_a + depth_b};
      }
    }
  }
  return deepest;
}

std::optional<SharedPoint> find_point_beyond(const PlacedSolid& solid, const Solid& outer,
                                             std::size_t lines, double tolerance, double rounding,
                                             std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const Extent& e = solid.solid.extent;
  const double reach = 2 * (norm(e.max - e.min) + norm(outer.extent.max - outer.extent.min) +
                            norm(to_outer(solid.transformation, 0.5 * (e.min + e.max)) -
                                 0.5 * (outer.extent.min + outer.extent.max))) +
                       rounding;
  for (std::size_t i = 0; i < lines; ++i) {
    const std::optional<Line> line = line_through(random, solid.transformation, e, reach);
    if (!line) continue;
    const auto& [start, v] = *line;
    const std::vector<Chord> within = chords_along(outer.any(), start, v, 2 * reach, rounding);
    for (const Chord& c : chords_of(solid, start, v, 2 * reach, rounding)) {
      // The gaps between the chords of `outer`, from this chord's begin to its end.
      double from = c.enter;
      for (std::size_t k = 0; k <= within.size(); ++k) {
        const double to = k < within.size() ? std::min(within[k].enter, c.leave) : c.leave;
        const Vec3 middle = start + 0.5 * (from + to) * v;
        if (to - from > tolerance && depth_in(solid, middle, tolerance) > 0 &&
            inside(outer.any(), middle, tolerance) == Side::outside) {
          return SharedPoint{middle, std::max(tolerance, depth_in(solid, middle, tolerance) +
                                                             safety_to_in(outer.any(), middle))};
        }
        if (k < within.size()) from = std::max(from, within[k].leave);
      }
    }
  }
  return std::nullopt;
}

}  // namespace navjit
