// Rays through the detector by the basket: the same steps as one by one (transport.hpp).
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "navjit/basket.hpp"
#include "runtime/transport.hpp"

namespace navjit {

/// What each of some rays came to, in their order. Whenever a ray has left the world the next one
/// takes its place. `sink(ray, state, length)` is called for each step with the ray's number among
/// these and the state that the step was made in; steps of a ray come in order. Between steps
/// `go_on()` is asked: once it says no, all ends where it is, and there are totals only of the
/// first rays that are complete, up to one that is not.
template <class Sink, class GoOn>
std::vector<RayTotals> transport_in_basket(Basket& basket, std::span<const Ray> rays,
                                           double tolerance, Sink&& sink, GoOn&& go_on) {
  struct Place {
    std::size_t ray;
    int standing;
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
  // The next ray that starts in the world; the place stays outside where there is none.
  const auto begin = [&](std::size_t i) {
    while (next < rays.size()) {
      const Ray& ray = rays[next];
      place[i] = {next++, 0};
      x[i] = ray.position.x, y[i] = ray.position.y, z[i] = ray.position.z;
      u[i] = ray.direction.x, v[i] = ray.direction.y, w[i] = ray.direction.z;
      state[i] = basket.locate(i, ray.position, ray.direction);
      if (state[i].inside()) {
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
      at.standing = length[i] > tolerance ? 0 : at.standing + 1;
      bool ends = at.standing == stuck_after;
      if (ends) {
        total.stuck = true;
      } else {
        sink(at.ray, state[i], length[i]);
        ++total.steps;
        total.length += length[i];
        x[i] += length[i] * u[i];
        y[i] += length[i] * v[i];
        z[i] += length[i] * w[i];
        ends = !after[i].inside();
      }
      state[i] = ends ? State{} : after[i];
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
