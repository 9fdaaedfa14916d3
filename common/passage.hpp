// A ray through the whole detector, from wherever it begins: what it passes, leg by leg.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "geometry/model/world.hpp"
#include "runtime/transport.hpp"

namespace navjit::common {

/// A step of a ray.
struct Leg {
  State state;      ///< where it was made
  State before;     ///< where the ray came from; outside for the first leg in the world
  Vec3 point;       ///< where it begins, mm
  double from, to;  ///< way from the start of the ray, mm
};

enum class PassageEnd : std::uint8_t { left, stopped, stuck };

/// How far a point outside the world is from it in a direction, mm; infinite if the world is not
/// there.
inline double way_into(const World& world, const Vec3& point, const Vec3& direction) {
  const Solid& solid = world.volumes[world.top].solid;
  return distance_to_in(solid.any(), point,
                        kernels::make_direction(direction.x, direction.y, direction.z),
                        world.tolerance);
}

/// Transports a ray that may begin outside the world, until it has left it for good, or until
/// `sink(leg)` says no. The way to the world is no leg. As transport() for rays from within; throws
/// what navigators throw.
template <class AnyNavigator, class Sink>
PassageEnd pass(AnyNavigator& navigator, const World& world, const Ray& ray, Sink&& sink) {
  // A world that is not convex may be entered again, and a mesh of many teeth is no reason to hang.
  constexpr int most_entries = 64;
  double way = 0;
  Vec3 point = ray.position;
  State state = navigator.locate(point, ray.direction);
  detail::Standing standing;
  for (int entries = 0; entries < most_entries; ++entries) {
    if (!state.inside()) {
      const double in = way_into(world, point, ray.direction);
      if (!std::isfinite(in) || in >= 1e30) return PassageEnd::left;
      // From far away the point on the surface is known to the rounding of its distance.
      double push = std::max(world.tolerance, 0x1p-50 * (way + in));
      double there = way + in;
      for (int tries = 0; tries < 8; ++tries, push *= 4) {
        point = ray.position + there * ray.direction;
        state = navigator.locate(point, ray.direction);
        if (state.inside()) break;
        there = way + in + push;
      }
      way = there;
      if (!state.inside()) continue;
    }
    for (State before{}; state.inside();) {
      const Step step = navigator.step(state, point, ray.direction);
      standing.count(step.length, world.tolerance);
      if (standing.stuck()) return PassageEnd::stuck;
      if (!sink(Leg{state, before, point, way, way + step.length})) return PassageEnd::stopped;
      way += step.length;
      point += step.length * ray.direction;
      before = state;
      state = step.next;
    }
  }
  return PassageEnd::left;
}

}  // namespace navjit::common
