#include "apps/accuracy/observed.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>

#include "common/interruption.hpp"
#include "navjit/runtime.hpp"
#include "runtime/processor_time.hpp"

namespace navjit::accuracy {
namespace {

/// What a ray goes through.
struct Through {
  double radiation_lengths = 0;
  std::vector<double> paths;  ///< by material, mm
};

/// Rays that take turns: the shortest time of each is taken.
constexpr std::size_t rays_of_a_turn = 64;

struct Way {
  ObservedDetector seen;
  Runtime generic, data;
  Navigator with_generic, with_data;
  double generic_s = 0, data_s = 0;
  std::uint64_t steps = 0;

  static RuntimeOptions options(JitMode jit) {
    RuntimeOptions made;
    made.jit = jit;
    // What the library has compiled serves here; no compiler is waited for.
    made.specialiser.constants = made.specialiser.structures = made.specialiser.safety = false;
    return made;
  }
  Way(const Detector& detector, const Observation& observation)
      : seen(detector, observation),
        generic(seen.detector(), options(JitMode::off)),
        data(seen.detector(), options(JitMode::wait)),
        with_generic(generic.navigator()),
        with_data(data.navigator()) {}

  Through through(const Ray& ray) {
    const Detector& world = seen.detector();  // mixtures are materials of its own
    Through sum{0, std::vector<double>(world.materials())};
    ObservedNavigator navigator(seen, with_generic);
    transport(navigator, ray, world.tolerance(), [&](const State& at, double length) {
      const LogicalVolume& volume = world.volume(at.volume());
      const double x0 = world.material(volume).radiation_length;
      if (x0 > 0) sum.radiation_lengths += length / x0;
      if (volume.material < sum.paths.size()) sum.paths[volume.material] += length;
      ++steps;
    });
    return sum;
  }
  double time(Navigator& by, const std::vector<Ray>& rays, std::size_t first, std::size_t last) {
    ObservedNavigator navigator(seen, by);
    const double begun = thread_seconds();
    for (std::size_t i = first; i < last; ++i) {
      transport(navigator, rays[i], seen.original().tolerance());
    }
    return thread_seconds() - begun;
  }
};

void time_all(std::vector<std::unique_ptr<Way>>& ways, const std::vector<Ray>& rays,
              int repetitions) {
  for (std::size_t first = 0; first < rays.size(); first += rays_of_a_turn) {
    const std::size_t last = std::min(rays.size(), first + rays_of_a_turn);
    std::vector<double> generic(ways.size(), INFINITY), data = generic;
    for (int turn = 0; turn < repetitions; ++turn) {
      for (std::size_t w = 0; w < ways.size(); ++w) {
        Way& way = *ways[w];
        generic[w] = std::min(generic[w], way.time(way.with_generic, rays, first, last));
        data[w] = std::min(data[w], way.time(way.with_data, rays, first, last));
      }
      common::stop_if_interrupted();
    }
    for (std::size_t w = 0; w < ways.size(); ++w) {
      ways[w]->generic_s += generic[w];
      ways[w]->data_s += data[w];
    }
  }
}

}  // namespace

std::vector<ObservedFigures> compare_observations(const Detector& detector,
                                                  const std::vector<Observation>& observations,
                                                  const std::vector<Ray>& rays, int repetitions) {
  std::vector<std::unique_ptr<Way>> ways;
  ways.push_back(std::make_unique<Way>(detector, Observation{}));
  for (const Observation& o : observations) ways.push_back(std::make_unique<Way>(detector, o));
  std::vector<ObservedFigures> all(ways.size());
  std::vector<std::vector<double>> changes(ways.size());
  for (const Ray& ray : rays) {
    const Through before = ways[0]->through(ray);
    changes[0].push_back(0);
    for (std::size_t w = 1; w < ways.size(); ++w) {
      const Through after = ways[w]->through(ray);
      changes[w].push_back(std::abs(after.radiation_lengths - before.radiation_lengths));
      for (std::size_t m = 0; m < before.paths.size(); ++m) {
        all[w].largest_path =
            std::max(all[w].largest_path, std::abs(after.paths[m] - before.paths[m]));
      }
    }
    common::stop_if_interrupted();
  }
  time_all(ways, rays, repetitions);
  const auto count = static_cast<double>(rays.size());
  for (std::size_t w = 0; w < ways.size(); ++w) {
    const Way& way = *ways[w];
    ObservedFigures& f = all[w];
    f.observe = observation_text(way.seen.observation());
    f.bound = way.seen.report().bound;
    f.steps_per_ray = static_cast<double>(way.steps) / count;
    f.ns_per_ray = 1e9 * way.generic_s / count;
    f.data_ns_per_ray = 1e9 * way.data_s / count;
    std::sort(changes[w].begin(), changes[w].end());
    f.mean = std::accumulate(changes[w].begin(), changes[w].end(), 0.0) / count;
    f.most_of_1000 = changes[w][static_cast<std::size_t>(0.999 * (count - 1))];
    f.largest = changes[w].back();
  }
  return all;
}

void print(const std::vector<ObservedFigures>& figures) {
  std::printf("%-28s %10s %10s %6s %10s %6s  %s\n", "observe", "steps/ray", "ns/ray", "",
              "bound to", "", "radiation lengths of a ray: mean, 99.9%, largest, bound");
  std::printf("%-28s %10s %10s %6s %10s %6s\n", "", "", "generic", "times", "data", "times");
  for (const ObservedFigures& f : figures) {
    std::printf("%-28s %10.2f %10.0f %6.2f %10.0f %6.2f  %.3g %.3g %.3g %.3g\n", f.observe.c_str(),
                f.steps_per_ray, f.ns_per_ray, figures[0].ns_per_ray / f.ns_per_ray,
                f.data_ns_per_ray, figures[0].data_ns_per_ray / f.data_ns_per_ray, f.mean,
                f.most_of_1000, f.largest, f.bound);
  }
}

nlohmann::ordered_json to_json(const std::vector<ObservedFigures>& figures) {
  auto all = nlohmann::ordered_json::array();
  for (const ObservedFigures& f : figures) {
    all.push_back({{"observe", f.observe},
                   {"bound_radiation_lengths", f.bound},
                   {"steps_per_ray", f.steps_per_ray},
                   {"generic_ns_per_ray", f.ns_per_ray},
                   {"bound_to_data_ns_per_ray", f.data_ns_per_ray},
                   {"mean_radiation_lengths", f.mean},
                   {"radiation_lengths_99.9_percent", f.most_of_1000},
                   {"largest_radiation_lengths", f.largest},
                   {"largest_path_mm", f.largest_path}});
  }
  return all;
}

bool any_beyond(const std::vector<ObservedFigures>& figures) {
  return std::any_of(figures.begin(), figures.end(), [](const ObservedFigures& f) {
    return f.largest > f.bound * (1 + 1e-9) + 1e-6;
  });
}

}  // namespace navjit::accuracy
