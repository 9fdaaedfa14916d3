#include "analysis/error_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/kernel_error.hpp"
#include "geometry/model/placed_extent.hpp"

namespace navjit {
namespace {

const double root3 = std::sqrt(3.0);
/// Allows for the rounding of the sums here, and for products of several roundings, which are left
/// out.
constexpr double slack = 1 + 1e-6;
/// How much longer than 1 a direction may be.
constexpr double longest_direction = 1 + 1e-5;

double length(const double (&v)[3]) { return std::hypot(v[0], v[1], v[2]); }

/// A bound of the distance of the box's points from the origin.
double radius_of(const Extent& e) {
  return std::hypot(std::max(std::abs(e.min.x), std::abs(e.max.x)),
                    std::max(std::abs(e.min.y), std::abs(e.max.y)),
                    std::max(std::abs(e.min.z), std::abs(e.max.z)));
}
double diagonal_of(const Extent& e) {
  return std::hypot(e.max.x - e.min.x, e.max.y - e.min.y, e.max.z - e.min.z);
}

double skew_at(const Transformation& t) { return t.rotated ? skew_of(t.rotation) : 0; }

/// How far the composed frame of a volume in the world may be from what the file says, in the worst
/// of all its touchables.
struct FrameError {
  bool reached = false;
  bool rotated = false;
  double origin = 0;     ///< how far the frame's origin may be from the world's, mm
  double position = 0;   ///< error of a local point, mm
  double direction = 0;  ///< error of a local direction of length 1
  double skew = 0;       ///< norm of R R' - 1, where R is the composed rotation

  void take(const FrameError& o) {
    reached = true;
    rotated |= o.rotated;
    origin = std::max(origin, o.origin);
    position = std::max(position, o.position);
    direction = std::max(direction, o.direction);
    skew = std::max(skew, o.skew);
  }
};

/// The error of a daughter's frame, given that of its mother's; the daughter's points are up to
/// `reach` from its origin.
FrameError into_daughter(const FrameError& mother, const Transformation& t, double reach) {
  const double away = length(t.translation), skew = skew_at(t);
  // R' = r R, rounded.
  const double turn =
      t.rotated && mother.rotated ? 3 * rounding(3) * (1 + skew) * (1 + mother.skew) : 0.0;
  // T' = T + R' t, rounded.
  const double shift = mother.rotated
                           ? rounding(4) * (mother.origin + root3 * (1 + mother.skew) * away)
                           : rounding(1) * (mother.origin + away);
  FrameError inner;
  inner.reached = true;
  inner.rotated = mother.rotated || t.rotated;
  inner.origin = (mother.origin + (1 + mother.skew) * away) * slack;
  inner.position = (1 + skew) * (mother.position + mother.skew * away + (1 + mother.skew) * shift) +
                   turn * reach * slack;
  inner.direction = (1 + skew) * mother.direction + turn;
  inner.skew = skew + (1 + skew) * mother.skew + 2 * turn * slack;
  return inner;
}

/// The rounding error of a position when a frame is applied: of the difference, and of the rotation
/// after it.
double applied(bool rotated, double skew, double reach) {
  return (rotated ? rounding(4) * root3 * (1 + skew) : rounding(1)) * reach;
}
double turned(bool rotated, double skew) {
  return rotated ? rounding(3) * root3 * (1 + skew) * longest_direction : 0;
}

/// The volumes in the tree, mothers before daughters.
std::vector<VolumeId> from_the_top(const World& world) {
  std::vector<char> seen(world.volumes.size(), 0);
  std::vector<VolumeId> order;
  // This goes depth first and notes daughters before their mothers. The tree is at most max_depth
  // deep.
  const auto visit = [&](const auto& self, VolumeId volume) -> void {
    seen[volume] = 1;
    for (const Placement& d : world.volumes[volume].daughters) {
      if (!seen[d.volume]) self(self, d.volume);
    }
    order.push_back(volume);
  };
  visit(visit, world.top);
  std::reverse(order.begin(), order.end());
  return order;
}

/// By volume: the box around its solid and all that is placed in it, in its frame, mm. The parts of
/// daughters outside of their mother also belong to the mother's scene.
std::vector<Extent> full_extents(const World& world, const std::vector<VolumeId>& order) {
  std::vector<Extent> full(world.volumes.size());
  for (std::size_t i = order.size(); i-- > 0;) {
    const LogicalVolume& volume = world.volumes[order[i]];
    Extent& box = full[order[i]];
    box = volume.solid.extent;
    for (const Placement& d : volume.daughters) {
      Solid inner;
      inner.extent = full[d.volume];
      const Extent e = placed_extent(inner, d.transformation);
      box.min = {std::min(box.min.x, e.min.x), std::min(box.min.y, e.min.y),
                 std::min(box.min.z, e.min.z)};
      box.max = {std::max(box.max.x, e.max.x), std::max(box.max.y, e.max.y),
                 std::max(box.max.z, e.max.z)};
    }
  }
  return full;
}

ErrorBound bound_of(const World& world, VolumeId volume, const Extent& box,
                    const FrameError& frame) {
  const LogicalVolume& scene = world.volumes[volume];
  const double reach = radius_of(box) * slack + world.tolerance;
  const double path = (diagonal_of(box) * slack + world.tolerance) * longest_direction;
  const double own =
      frame.position + applied(frame.rotated, frame.skew, reach) +
      path * (frame.direction * longest_direction + turned(frame.rotated, frame.skew));
  ErrorBound bound;
  // A start within the tolerance of a face counts as on it, and a corner or a grazed part of the
  // solid that is less deep than this is passed over.
  bound.tolerance = 2 * world.tolerance;
  const auto add = [&](const Solid& solid, double displaced, double from) {
    const auto kernel = kernel_error(solid.any(), {from, path, world.tolerance});
    if (!kernel && bound.unknown.empty()) bound.unknown = kind_name(solid.kind);
    bound.frame = std::max(bound.frame, displaced * slack);
    bound.kernel = std::max(bound.kernel, kernel.value_or(0) * slack);
  };
  add(scene.solid, own, reach);
  for (const Placement& d : scene.daughters) {
    const Transformation& t = d.transformation;
    const double skew = skew_at(t), from = reach + length(t.translation);
    add(world.volumes[d.volume].solid,
        (1 + skew) * own + applied(t.rotated, skew, from) + path * turned(t.rotated, skew),
        (1 + skew) * from);
  }
  return bound;
}

}  // namespace

double ErrorBound::total() const {
  return known() ? tolerance + frame + kernel : std::numeric_limits<double>::infinity();
}

std::vector<ErrorBound> error_bounds(const World& world) {
  const std::vector<VolumeId> order = from_the_top(world);
  const std::vector<Extent> boxes = full_extents(world, order);
  std::vector<FrameError> frames(world.volumes.size());
  frames[world.top].reached = true;
  for (const VolumeId volume : order) {
    for (const Placement& d : world.volumes[volume].daughters) {
      frames[d.volume].take(
          into_daughter(frames[volume], d.transformation, radius_of(boxes[d.volume]) * slack));
    }
  }
  std::vector<ErrorBound> bounds(world.volumes.size());
  for (std::size_t v = 0; v < bounds.size(); ++v) {
    if (frames[v].reached) {
      bounds[v] = bound_of(world, static_cast<VolumeId>(v), boxes[v], frames[v]);
    } else {
      bounds[v].unknown = "volume outside the tree";
    }
  }
  return bounds;
}

}  // namespace navjit
