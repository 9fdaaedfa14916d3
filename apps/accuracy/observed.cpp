#include "apps/accuracy/observed.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include "apps/accuracy/through.hpp"
#include "common/interruption.hpp"
#include "navjit/gdml.hpp"
#include "navjit/runtime.hpp"
#include "runtime/private_folder.hpp"
#include "runtime/processor_time.hpp"

namespace navjit::accuracy {
namespace {

constexpr std::size_t direction_bins = 10;
/// For this many rays it is looked up where they come into observed volumes, which takes its time.
constexpr std::size_t rays_with_entries = 10000;
/// Rays that take turns: the shortest time of each is taken.
constexpr std::size_t rays_of_a_turn = 64;

struct Way {
  ObservedDetector seen;
  Passing passing;
  Runtime generic, data;
  Navigator with_generic, with_data;
  double generic_s = 0, data_s = 0;
  std::uint64_t steps = 0;

  static RuntimeOptions options(JitMode jit) {
    RuntimeOptions made;
    made.jit = jit;
    // What the library has compiled serves here; no compiler is waited for.
    made.specialiser.constants = made.specialiser.structures = false;
    made.specialiser.solids = made.specialiser.safety = false;
    return made;
  }
  Way(const Detector& detector, const Observation& observation)
      : seen(detector, observation),
        passing(seen),
        generic(seen.detector(), options(JitMode::off)),
        data(seen.detector(), options(JitMode::wait)),
        with_generic(generic.navigator()),
        with_data(data.navigator()) {}

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

std::size_t bin_of(const Ray& ray) {
  const double bin = (ray.direction.z + 1) / 2 * direction_bins;
  return std::min(static_cast<std::size_t>(std::max(bin, 0.0)), direction_bins - 1);
}

/// What an observation changes along rays; grows ray by ray.
struct Changes {
  std::vector<double> all;
  std::vector<std::vector<double>> by_direction{direction_bins};
  std::vector<double> whole_by_direction = std::vector<double>(direction_bins);
  std::vector<double> before, after, change;  // by material
  double whole = 0;

  void add(const Ray& ray, const Through& a, const Through& b, const ObservedDetector& seen,
           ObservedFigures& f) {
    const double difference = std::abs(b.radiation_lengths - a.radiation_lengths);
    all.push_back(difference);
    whole += a.radiation_lengths;
    by_direction[bin_of(ray)].push_back(difference);
    whole_by_direction[bin_of(ray)] += a.radiation_lengths;
    for (auto* sums : {&before, &after, &change}) sums->resize(a.paths.size());
    for (std::size_t m = 0; m < a.paths.size(); ++m) {
      const double moved = std::abs(b.paths[m] - a.paths[m]);
      f.largest_path = std::max(f.largest_path, moved);
      before[m] += a.paths[m];
      after[m] += b.paths[m];
      change[m] += moved;
    }
    add_entries(observed(a, seen), observed(b, seen), f.entries);
  }

  /// Entries into what this way observes, of those into what any way does.
  static std::vector<Entry> observed(const Through& through, const ObservedDetector& seen) {
    std::vector<Entry> some;
    for (const Entry& e : through.entries) {
      if (seen.observed(e.state.volume())) some.push_back(e);
    }
    return some;
  }

  static void add_entries(const std::vector<Entry>& a, const std::vector<Entry>& b,
                          EntryFigures& f) {
    f.before += a.size();
    f.after += b.size();
    bool same = a.size() == b.size();
    for (std::size_t i = 0; same && i < a.size(); ++i) same = a[i].state == b[i].state;
    if (!same) {
      ++f.rays_that_differ;
      return;
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
      f.largest = std::max(f.largest, std::abs(a[i].path - b[i].path));
    }
  }

  static double mean(const std::vector<double>& values) {
    if (values.empty()) return 0;
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  }
  /// The values have to be sorted.
  static double at(const std::vector<double>& values, double share) {
    if (values.empty()) return 0;
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  }

  void finish(const Detector& original, ObservedFigures& f) {
    const auto count = static_cast<double>(std::max<std::size_t>(all.size(), 1));
    std::sort(all.begin(), all.end());
    f.whole = whole / count;
    f.mean = mean(all);
    f.most_of_1000 = at(all, 0.999);
    f.largest = at(all, 1);
    for (std::size_t b = 0; b < direction_bins; ++b) {
      std::vector<double>& values = by_direction[b];
      std::sort(values.begin(), values.end());
      const double width = 2.0 / direction_bins, low = -1 + width * static_cast<double>(b);
      f.directions.push_back(
          {low, low + width, values.size(),
           values.empty() ? 0 : whole_by_direction[b] / static_cast<double>(values.size()),
           mean(values), at(values, 0.99), at(values, 1)});
    }
    for (std::size_t m = 0; m < before.size(); ++m) {
      if (before[m] == 0 && after[m] == 0) continue;
      f.materials.push_back({original.material(static_cast<std::uint32_t>(m)).name,
                             before[m] / count, after[m] / count, change[m] / count});
    }
  }
};

void measure_vecgeom(const std::vector<std::unique_ptr<Way>>& ways, const std::vector<Ray>& rays,
                     int repetitions, VecGeom::Options options,
                     std::vector<ObservedFigures>& figures) {
  const PrivateFolder folder;
  options.detector = folder.file("written.gdml");
  for (std::size_t w = 0; w < ways.size(); ++w) {
    std::ofstream(options.detector) << gdml_text(ways[w]->seen.detector());
    figures[w].vecgeom_failure =
        VecGeom(options).time_of_rays(rays, repetitions, figures[w].vecgeom_ns_per_ray);
    common::stop_if_interrupted();
  }
}

}  // namespace

std::vector<ObservedFigures> compare_observations(const Detector& detector,
                                                  const std::vector<Observation>& observations,
                                                  const std::vector<Ray>& rays, int repetitions,
                                                  const std::optional<VecGeom::Options>& vecgeom,
                                                  const std::function<void()>& prepared) {
  std::vector<std::unique_ptr<Way>> ways;
  ways.push_back(std::make_unique<Way>(detector, Observation{}));
  for (const Observation& o : observations) ways.push_back(std::make_unique<Way>(detector, o));
  if (prepared) prepared();
  std::vector<bool> observed(detector.volumes());
  for (const auto& way : ways) {
    for (VolumeId v = 0; v < observed.size(); ++v) {
      if (way->seen.observed(v)) observed[v] = true;
    }
  }
  if (std::find(observed.begin(), observed.end(), true) != observed.end()) {
    for (const auto& way : ways) way->passing.record_entries(observed);
  }
  std::vector<ObservedFigures> all(ways.size());
  std::vector<Changes> changes(ways.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Ray& ray = rays[i];
    const bool entries = i < rays_with_entries;
    const Through before =
        ways[0]->passing.through(ways[0]->with_data, ray, entries, ways[0]->steps);
    changes[0].add(ray, before, before, ways[0]->seen, all[0]);
    for (std::size_t w = 1; w < ways.size(); ++w) {
      Way& way = *ways[w];
      changes[w].add(ray, before, way.passing.through(way.with_data, ray, entries, way.steps),
                     way.seen, all[w]);
    }
    common::stop_if_interrupted();
  }
  if (repetitions > 0) time_all(ways, rays, repetitions);
  const auto count = static_cast<double>(rays.size());
  for (std::size_t w = 0; w < ways.size(); ++w) {
    const Way& way = *ways[w];
    const Observation& observation = way.seen.observation();
    ObservedFigures& f = all[w];
    f.observe = observation_text(observation);
    f.bound = way.seen.report().bound;
    f.promises = observation.unit == Observation::Unit::radiation_lengths ||
                 (observation.unit == Observation::Unit::relative &&
                  observation.kind == Observation::Kind::mixtures);
    f.steps_per_ray = static_cast<double>(way.steps) / count;
    f.ns_per_ray = 1e9 * way.generic_s / count;
    f.data_ns_per_ray = 1e9 * way.data_s / count;
    changes[w].finish(detector, f);
  }
  if (vecgeom && repetitions > 0) measure_vecgeom(ways, rays, repetitions, *vecgeom, all);
  return all;
}

bool any_beyond(const std::vector<ObservedFigures>& figures) {
  return std::any_of(figures.begin(), figures.end(), [](const ObservedFigures& f) {
    return f.promises && f.largest > f.bound * (1 + 1e-9) + 1e-6;
  });
}

}  // namespace navjit::accuracy
