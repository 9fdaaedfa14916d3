// Transports a ray through the detector step by step, for commands, tests and benchmarks.
#pragma once

#include <cstdint>

#include "geometry/rays/ray.hpp"
#include "navjit/detail/standing.hpp"
#include "navjit/navigator.hpp"

namespace navjit {

struct RayTotals {
  std::uint64_t steps = 0;
  double length = 0;  ///< mm
  bool stuck = false;
};

/// Transports one ray until it leaves the world, and calls sink(state, length) for each step with
/// the state in which it was made. A ray that starts outside makes no steps. The navigator may be a
/// Navigator or an ObservedNavigator.
template <class AnyNavigator, class Sink>
RayTotals transport(AnyNavigator& navigator, const Ray& ray, double tolerance, Sink&& sink) {
  RayTotals totals;
  Vec3 point = ray.position;
  detail::Standing standing;
  for (State state = navigator.locate(point, ray.direction); state.inside();) {
    const Step step = navigator.step(state, point, ray.direction);
    standing.count(step.length, tolerance);
    if (standing.stuck()) {
      totals.stuck = true;
      return totals;
    }
    sink(state, step.length);
    ++totals.steps;
    totals.length += step.length;
    point.x += step.length * ray.direction.x;
    point.y += step.length * ray.direction.y;
    point.z += step.length * ray.direction.z;
    state = step.next;
  }
  return totals;
}

template <class AnyNavigator>
RayTotals transport(AnyNavigator& navigator, const Ray& ray, double tolerance) {
  return transport(navigator, ray, tolerance, [](const State&, double) {});
}

}  // namespace navjit
