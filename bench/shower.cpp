#include "bench/shower.hpp"

#include <cmath>
#include <random>

#include "bench/flights.hpp"
#include "geometry/model/random.hpp"

namespace navjit::bench {
namespace {

/// A particle, and the number of steps that it has left, in tenths of a step.
struct Particle {
  State state;
  Vec3 point, direction;
  std::int64_t left;
};

/// The mean step in a material, mm; infinite where particles fly without interaction.
double mean_step_in(const Material& material, double mean_step) {
  constexpr double thinnest = 0.01;  // g/cm3
  if (material.density < thinnest || material.radiation_length <= 0) return INFINITY;
  return mean_step > 0 ? mean_step : std::max(0.2 * material.radiation_length, 0.01);
}

Vec3 scattered(const Vec3& direction, double spread, std::mt19937_64& random) {
  const Vec3 v = direction + spread * uniform(random, 0, 1) * unit_vector(random);
  return (1 / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z)) * v;
}

constexpr double isotropic = 1000;  // as a spread: the old direction counts a thousandth

}  // namespace

std::vector<peers::Flight> shower(Runtime& runtime, const std::vector<Ray>& primaries,
                                  const ShowerOptions& options) {
  Navigator navigator = runtime.navigator();
  const Detector& detector = runtime.detector();
  std::mt19937_64 random(options.seed);
  std::vector<peers::Flight> flights;
  for (const Ray& primary : primaries) {
    const Vec3& start = primary.position;
    peers::Flight flight{{start.x, start.y, start.z}, {}};
    std::vector<Particle> waiting{{navigator.locate(start, primary.direction), start,
                                   primary.direction, std::int64_t{10} * options.most_steps}};
    // A flight that makes no step is none: whoever repeats flights looks at their first steps.
    if (!waiting[0].state.inside() || waiting[0].left <= 0) continue;
    while (!waiting.empty()) {
      Particle particle = waiting.back();
      waiting.pop_back();
      while (particle.state.inside() && particle.left > 0) {
        const double mean = mean_step_in(detector.material(particle.state), options.mean_step);
        const double limit = std::isinf(mean) ? mean : -mean * std::log(1 - uniform(random, 0, 1));
        const Vec3 direction = particle.direction;
        const Step step = moved(navigator, particle.state, particle.point, direction, limit);
        particle.left -= step.boundary ? 1 : 10;
        bool secondary = false;
        if (!step.boundary) {
          secondary = uniform(random, 0, 1) < 0.05 && particle.left > 20;
          if (secondary) {
            particle.left /= 2;
            waiting.push_back(
                {particle.state, particle.point, scattered(direction, 1, random), particle.left});
          }
          particle.direction = scattered(direction, secondary ? isotropic : 0.2, random);
        }
        flight.steps.push_back({{direction.x, direction.y, direction.z},
                                std::min(limit, peers::no_limit),
                                secondary,
                                false});
      }
      flight.steps.back().stops = true;
    }
    flights.push_back(std::move(flight));
  }
  return flights;
}

}  // namespace navjit::bench
