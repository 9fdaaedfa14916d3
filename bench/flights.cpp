#include "bench/flights.hpp"

#include <algorithm>

#include "navjit/detail/standing.hpp"

namespace navjit::bench {

Step moved(Navigator& navigator, State& state, Vec3& point, const Vec3& direction, double limit) {
  Step step{};
  for (int standing = 0; standing < detail::Standing::most && state.inside(); ++standing) {
    step = navigator.step(state, point, direction, limit);
    point += step.length * direction;
    state = step.next;
    if (!step.boundary || step.length > peers::no_length) break;
  }
  return step;
}

Followed follow(Navigator& navigator, const std::vector<peers::Flight>& flights, Asked asked) {
  Followed done;
  struct Place {
    State state;
    Vec3 point;
    bool on_boundary;
  };
  std::vector<Place> waiting;
  for (const peers::Flight& flight : flights) {
    const auto direction_of = [](const peers::FlightStep& step) {
      return Vec3{step.direction[0], step.direction[1], step.direction[2]};
    };
    Place at{{}, {flight.start[0], flight.start[1], flight.start[2]}, false};
    at.state = navigator.locate(at.point, direction_of(flight.steps.front()));
    waiting.clear();
    for (const peers::FlightStep& planned : flight.steps) {
      if (at.state.inside()) {
        const Vec3 direction = direction_of(planned);
        if (asked != Asked::none && !at.on_boundary) {
          done.safeties += asked == Asked::whole
                               ? navigator.safety(at.state, at.point)
                               : navigator.safety(at.state, at.point, planned.limit);
        }
        const Step step = moved(navigator, at.state, at.point, direction, planned.limit);
        at.on_boundary = step.boundary;
        ++done.steps;
        done.length += step.length;
      }
      if (planned.secondary) waiting.push_back(at);
      if (planned.stops && !waiting.empty()) {
        at = waiting.back();
        waiting.pop_back();
      }
    }
  }
  return done;
}

}  // namespace navjit::bench
