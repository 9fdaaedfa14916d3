#include "apps/accuracy/track.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/interruption.hpp"
#include "geometry/model/random.hpp"
#include "navjit/detail/standing.hpp"
#include "navjit/vector.hpp"

namespace navjit::accuracy {
namespace {

using reference::Quad;
using reference::WidePoint;

Vec3 narrow(const WidePoint& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

WidePoint moved(const WidePoint& p, const Leg& leg) {
  const Quad t = leg.length;
  return {p.x + t * leg.direction.x, p.y + t * leg.direction.y, p.z + t * leg.direction.z};
}

/// The state of one track.
struct Traveller {
  Navigator& navigator;
  double tolerance;
  Vec3 point;
  State state{};
  std::uint64_t boundaries = 0;

  /// False if it is stuck or leaves the world.
  bool follow(const Leg& leg) {
    double left = leg.length;
    for (detail::Standing standing; left > 0;) {
      const Step step = navigator.step(state, point, leg.direction, left);
      standing.count(step.length, tolerance);
      if (standing.stuck()) return false;
      point += step.length * leg.direction;
      left -= step.length;
      boundaries += step.boundary ? 1 : 0;
      state = step.next;
      if (!state.inside()) return false;
    }
    return true;
  }
};

/// A point in the world, not near its surface; nothing if a few hundred tries find none.
std::optional<Vec3> interior_point(const reference::WideGeometry& reference,
                                   std::mt19937_64& random) {
  const World& world = reference.world();
  const Extent& e = world.volumes[world.top].solid.extent;
  const double margin = 1e3 * world.tolerance;
  for (int i = 0; i < 500; ++i) {
    const Vec3 p{uniform(random, e.min.x, e.max.x), uniform(random, e.min.y, e.max.y),
                 uniform(random, e.min.z, e.max.z)};
    if (reference.side_of_world(reference::widen(p), margin) == Side::inside) return p;
  }
  return std::nullopt;
}

}  // namespace

Track make_track(const reference::WideGeometry& reference, Navigator& navigator,
                 std::uint64_t boundaries, std::uint64_t seed, std::size_t most_legs) {
  std::mt19937_64 random(seed);
  const World& world = reference.world();
  Track track;
  const std::optional<Vec3> start = interior_point(reference, random);
  if (!start) return track;
  track.start = *start;
  Traveller traveller{navigator, world.tolerance, *start, navigator.locate(*start)};
  if (!traveller.state.inside()) return track;
  const double margin = 1e3 * world.tolerance;
  // Tries are counted, too: in a world that is hardly convex most legs would leave it.
  for (std::size_t tries = 0;
       traveller.boundaries < boundaries && track.legs.size() < most_legs && tries < 10 * most_legs;
       ++tries) {
    common::stop_if_interrupted();
    const std::optional<Vec3> target = interior_point(reference, random);
    if (!target) break;
    const Vec3 way = *target - traveller.point;
    const double length = norm(way);
    if (!(length > 0)) continue;
    const Leg leg{(1 / length) * way, length};
    if (reference.exit(traveller.point, leg.direction) < Quad(length + margin)) continue;
    track.legs.push_back(leg);
    if (!traveller.follow(leg)) break;
  }
  return track;
}

std::vector<LegEnd> follow(Navigator& navigator, const World& world, const Track& track) {
  std::vector<LegEnd> ends;
  Traveller traveller{navigator, world.tolerance, track.start, navigator.locate(track.start)};
  if (!traveller.state.inside()) return ends;
  for (const Leg& leg : track.legs) {
    if (!traveller.follow(leg)) break;
    ends.push_back({traveller.point, traveller.boundaries});
  }
  return ends;
}

TrackResult judge_track(const World& world, const Track& track, const std::vector<LegEnd>& ends) {
  TrackResult result;
  const Extent& e = world.volumes[world.top].solid.extent;
  const double size = std::max({std::abs(e.min.x), std::abs(e.min.y), std::abs(e.min.z),
                                std::abs(e.max.x), std::abs(e.max.y), std::abs(e.max.z)});
  result.ulp = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  WidePoint exact = reference::widen(track.start);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    exact = moved(exact, track.legs[i]);
    const Vec3 off =
        narrow({ends[i].point.x - exact.x, ends[i].point.y - exact.y, ends[i].point.z - exact.z});
    result.drift = norm(off);
    result.largest = std::max(result.largest, result.drift);
    result.boundaries = ends[i].boundaries;
  }
  result.complete = !track.legs.empty() && ends.size() == track.legs.size();
  return result;
}

}  // namespace navjit::accuracy
