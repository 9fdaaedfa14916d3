// Transports rays through the detector in a basket, with the same steps as one by one
// (transport.hpp).
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "navjit/basket.hpp"
#include "navjit/detail/standing.hpp"
#include "navjit/observation.hpp"
#include "runtime/transport.hpp"

namespace navjit {

/// Every boundary ends a step.
struct AllCount {
  bool operator()(const State&, const State&) const { return true; }
};

/// Transports rays in the basket, and returns the totals of each, in their order. When a ray has
/// left the world the next one takes its place. `counts(from, to)` says whether a step ends on a
/// boundary between these states. If it does not, the step goes on, with the same bits as
/// ObservedDetector::step(). `sink(ray, state, length)` is called for each step with the ray's
/// index and the state in which the step was made; the steps of a ray come in order. `go_on()` is
/// called between steps. Once it returns false, transport stops at once, and there are totals only
/// of the first rays, up to the first one that is not complete.
template <class Sink, class GoOn, class Counts = AllCount>
std::vector<RayTotals> transport_in_basket(Basket& basket, std::span<const Ray> rays,
                                           double tolerance, Sink&& sink, GoOn&& go_on,
                                           const Counts& counts = {}) {
  /// A ray under way and the step that it makes. This is several steps of the basket if there are
  /// boundaries that do not count.
  struct Place {
    std::size_t ray = 0;
    detail::Standing standing{};
    Vec3 begin{};
    State state{};
    double length = 0;
    bool goes_on = false;
    detail::Standing standing_within{};
    Step ahead{};  ///< up to where the ray last got ahead within the step
  };
  const std::size_t places = std::min(basket.places(), rays.size());
  std::vector<Place> place(places);
  std::vector<State> state(places);
  std::vector<double> x(places), y(places), z(places), u(places), v(places), w(places),
      length(places);
  std::vector<std::uint8_t> boundary(places);
  std::vector<RayTotals> totals(rays.size());
  std::vector<char> complete(rays.size(), 0);
  std::size_t next = 0, under_way = 0;
  // Begins the next ray that starts in the world. If there is none, the place stays outside.
  const auto begin = [&](std::size_t i) {
    while (next < rays.size()) {
      const Ray& ray = rays[next];
      place[i] = {.ray = next++, .begin = ray.position};
      x[i] = ray.position.x, y[i] = ray.position.y, z[i] = ray.position.z;
      u[i] = ray.direction.x, v[i] = ray.direction.y, w[i] = ray.direction.z;
      state[i] = basket.locate(i, ray.position, ray.direction);
      if (state[i].inside()) {
        place[i].state = state[i];
        ++under_way;
        return;
      }
      complete[place[i].ray] = 1;
    }
  };
  for (std::size_t i = 0; i < places; ++i) begin(i);
  std::vector<State> after(places);
  const Tracks tracks{state, x, y, z, u, v, w};
  const Steps steps{length, boundary, after};
  while (under_way > 0 && go_on()) {
    basket.step(tracks, steps);
    for (std::size_t i = 0; i < places; ++i) {
      if (!state[i].inside()) continue;
      Place& at = place[i];
      RayTotals& total = totals[at.ray];
      const bool first = !at.goes_on;
      at.length += length[i];
      at.goes_on = boundary[i] != 0 && after[i].inside() && !counts(state[i], after[i]);
      if (at.goes_on) {
        if (!first) at.standing_within.count(length[i], tolerance);
        if (at.standing_within.stuck()) {
          at.goes_on = false;
          at.length = at.ahead.length;
          after[i] = at.ahead.next;
        } else if (at.standing_within.steps == 0) {
          at.ahead = {at.length, true, after[i]};
        }
      }
      x[i] = at.begin.x + at.length * u[i];
      y[i] = at.begin.y + at.length * v[i];
      z[i] = at.begin.z + at.length * w[i];
      state[i] = after[i];
      if (at.goes_on) continue;
      at.standing.count(at.length, tolerance);
      bool ends = at.standing.stuck();
      if (ends) {
        total.stuck = true;
      } else {
        sink(at.ray, at.state, at.length);
        ++total.steps;
        total.length += at.length;
        ends = !after[i].inside();
      }
      if (ends) state[i] = State{};
      at.begin = {x[i], y[i], z[i]};
      at.state = state[i];
      at.length = 0;
      at.standing_within = {};
      if (!ends) continue;
      complete[at.ray] = 1;
      --under_way;
      begin(i);
    }
  }
  totals.resize(
      static_cast<std::size_t>(std::find(complete.begin(), complete.end(), 0) - complete.begin()));
  return totals;
}

}  // namespace navjit
