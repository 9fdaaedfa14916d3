#include "bench/photons.hpp"

#include <cmath>
#include <random>

#include "bench/flights.hpp"
#include "geometry/model/random.hpp"

namespace navjit::bench {
namespace {

/// The most steps of a ray from which a photon's start is chosen, so that no ray goes on for ever.
constexpr std::uint64_t most_steps_of_start = 100000;

Vec3 unit(const Vec3& v) { return (1 / norm(v)) * v; }

double along(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// The middle of one of the steps that a ray makes, each equally likely; the ray's start if it
/// misses the world.
Vec3 start_along(Navigator& navigator, const Ray& ray, std::mt19937_64& random) {
  Vec3 point = ray.position, chosen = point;
  State state = navigator.locate(point, ray.direction);
  for (std::uint64_t steps = 1; state.inside() && steps < most_steps_of_start; ++steps) {
    const Vec3 begin = point;
    moved(navigator, state, point, ray.direction, peers::no_limit);
    if (random() % steps == 0) chosen = 0.5 * (begin + point);
  }
  return chosen;
}

}  // namespace

std::vector<peers::Flight> photons(Runtime& runtime, const std::vector<Ray>& rays,
                                   const PhotonOptions& options) {
  Navigator navigator = runtime.navigator();
  std::mt19937_64 random(options.seed);
  std::vector<peers::Flight> flights;
  for (const Ray& ray : rays) {
    Vec3 point = start_along(navigator, ray, random), direction = unit_vector(random);
    State state = navigator.locate(point, direction);
    // A flight that makes no step is none: whoever repeats flights looks at their first steps.
    if (!state.inside() || options.most_steps <= 0) continue;
    peers::Flight flight{{point.x, point.y, point.z}, {}};
    for (int left = options.most_steps; left > 0 && state.inside(); --left) {
      flight.steps.push_back(
          {{direction.x, direction.y, direction.z}, peers::no_limit, false, false});
      moved(navigator, state, point, direction, 0);  // back again, if it was reflected
      const State from = state;
      moved(navigator, state, point, direction, peers::no_limit);
      if (!state.inside()) break;
      // It meets a mirror, or goes through a rough face into another medium.
      if (uniform(random, 0, 1) < options.reflected) {
        const Vec3 normal = navigator.boundary_normal(from, state, point);
        direction = unit(direction - 2 * along(direction, normal) * normal);
      } else {
        direction = unit(direction + 0.2 * uniform(random, 0, 1) * unit_vector(random));
      }
    }
    flight.steps.back().stops = true;
    flights.push_back(std::move(flight));
  }
  return flights;
}

}  // namespace navjit::bench
