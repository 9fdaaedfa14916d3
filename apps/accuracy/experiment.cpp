#include "apps/accuracy/experiment.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>

#include "apps/accuracy/levels.hpp"
#include "common/clock.hpp"
#include "common/interruption.hpp"
#include "common/parallel.hpp"
#include "common/statistics.hpp"
#include "navjit/vector.hpp"

namespace navjit::accuracy {
namespace {

using Clock = std::chrono::steady_clock;

bool interrupted() { return common::interruption() != 0; }

/// Calls work(index) for all of [0, count), on so many threads, with what each thread keeps; after
/// a signal for no more of them.
template <class Kept, class Make, class Work, class Merge>
void for_all(std::size_t count, unsigned threads, Make make, Work work, Merge merge) {
  std::atomic<std::size_t> next{0};
  std::mutex merging;
  std::atomic<bool> stop{false};
  common::in_parallel(threads, stop, [&] {
    Kept kept = make();
    for (std::size_t i; !stop && !interrupted() && (i = next.fetch_add(1)) < count;) work(kept, i);
    const std::lock_guard lock(merging);
    merge(kept);
  });
}

/// Steps of all levels, ray by ray: where a level does what the generic navigator does, to the last
/// bit, the verdict is the same, too.
void compare_levels(const reference::WideGeometry& reference, std::vector<LevelEngine>& levels,
                    const std::vector<Ray>& rays, unsigned threads, ExperimentReport& report) {
  const World& world = reference.world();
  const Tolerances tolerances = own_tolerances(world);
  const std::vector<ErrorBound> bounds = error_bounds(world);
  struct Kept {
    std::vector<Navigator> navigators;
    std::vector<EngineFigures> figures;
  };
  for_all<Kept>(
      rays.size(), threads,
      [&] {
        Kept kept;
        for (LevelEngine& level : levels) kept.navigators.push_back(level.runtime().navigator());
        kept.figures.resize(levels.size());
        return kept;
      },
      [&](Kept& kept, std::size_t i) {
        const MadeRay first = make_ray_steps(kept.navigators[0], world, rays[i], i);
        const JudgedRay judged = judge_ray(reference, rays[i], first, tolerances);
        kept.figures[0].equal += first.steps.size();
        kept.figures[0].add(world, rays[i], first, judged);
        kept.figures[0].hold_against(bounds, judged);
        for (std::size_t l = 1; l < levels.size(); ++l) {
          const MadeRay made = make_ray_steps(kept.navigators[l], world, rays[i], i);
          kept.figures[l].equal += equal_steps(first, made);
          const JudgedRay other =
              identical(first, made) ? judged : judge_ray(reference, rays[i], made, tolerances);
          kept.figures[l].add(world, rays[i], made, other);
          kept.figures[l].hold_against(bounds, other);
        }
      },
      [&](const Kept& kept) {
        for (std::size_t l = 0; l < levels.size(); ++l) {
          report.engines[l].figures.append(kept.figures[l]);
        }
      });
}

/// The steps made; nothing if a signal came before the end.
std::optional<std::uint64_t> transport_all(Navigator& navigator, const World& world,
                                           const std::vector<Ray>& rays) {
  std::uint64_t steps = 0;
  for (const Ray& ray : rays) {
    if (interrupted()) return std::nullopt;
    transport(navigator, ray, world.tolerance,
              [&](const State&, double length) { steps += length > world.tolerance ? 1 : 0; });
  }
  return steps;
}

/// Whole rays, engines in turn, in processor time of this thread.
void time_levels(std::vector<LevelEngine>& levels, const World& world, const std::vector<Ray>& rays,
                 int repetitions, ExperimentReport& report) {
  std::vector<Navigator> navigators;
  navigators.reserve(levels.size());
  for (LevelEngine& level : levels) navigators.push_back(level.runtime().navigator());
  std::vector<std::vector<double>> times(levels.size());
  for (int r = -1; r < repetitions && !interrupted(); ++r) {  // the first one warms up
    for (std::size_t l = 0; l < levels.size(); ++l) {
      const double start = common::thread_ns();
      const std::optional<std::uint64_t> steps = transport_all(navigators[l], world, rays);
      const double ns = common::thread_ns() - start;
      // Rays that make no step tell nothing of what a step costs.
      if (r >= 0 && steps.value_or(0) > 0) times[l].push_back(ns / static_cast<double>(*steps));
    }
  }
  for (std::size_t l = 0; l < levels.size(); ++l) {
    if (!times[l].empty()) report.engines[l].ns_per_step = common::summarise(times[l]).median;
  }
}

/// A step, to be made once more.
struct RecordedStep {
  State state;
  Vec3 point, direction;
};

/// The first steps of the rays, by the volume that they are made in. What a signal left out is
/// missing.
std::map<VolumeId, std::vector<RecordedStep>> record_steps(Navigator& navigator, const World& world,
                                                           const std::vector<Ray>& rays) {
  constexpr std::size_t most_of_a_scene = 1000;
  std::map<VolumeId, std::vector<RecordedStep>> recorded;
  for (const Ray& ray : rays) {
    if (interrupted()) break;
    Vec3 point = ray.position;
    detail::Standing standing;
    for (State state = navigator.locate(point, ray.direction);
         state.inside() && !standing.stuck();) {
      std::vector<RecordedStep>& of_scene = recorded[state.volume()];
      if (of_scene.size() < most_of_a_scene) of_scene.push_back({state, point, ray.direction});
      const Step step = navigator.step(state, point, ray.direction);
      standing.count(step.length, world.tolerance);
      point += step.length * ray.direction;
      state = step.next;
    }
  }
  return recorded;
}

/// The steps of each scene in a row, in processor time of this thread: a single one is shorter than
/// reading that clock. Medians of some rows, the first of which warms up.
std::map<VolumeId, double> time_scenes(LevelEngine& level, const World& world,
                                       const std::vector<Ray>& rays) {
  constexpr int rows = 5;
  constexpr std::size_t least_steps = 2000;  // of a row
  Navigator navigator = level.runtime().navigator();
  std::map<VolumeId, double> medians;
  for (const auto& [volume, steps] : record_steps(navigator, world, rays)) {
    const std::size_t rounds = (least_steps + steps.size() - 1) / steps.size();
    std::vector<double> times;
    for (int row = -1; row < rows && !interrupted(); ++row) {
      const double start = common::thread_ns();
      for (std::size_t round = 0; round < rounds; ++round) {
        for (const RecordedStep& s : steps) navigator.step(s.state, s.point, s.direction);
      }
      const double ns = common::thread_ns() - start;
      if (row >= 0) times.push_back(ns / static_cast<double>(rounds * steps.size()));
    }
    if (!times.empty()) medians[volume] = common::quantile(times, 0.5);
  }
  return medians;
}

void add_vecgeom(const reference::WideGeometry& reference, const std::vector<Ray>& rays,
                 const Track& track, const ExperimentOptions& options, ExperimentReport& report) {
  const VecGeom vecgeom(*options.vecgeom);
  EngineReport engine;
  engine.name = "VecGeom";
  const World& world = reference.world();
  std::vector<MadeRay> made;
  engine.failure = vecgeom.trace(rays, [&](MadeRay& ray) { made.push_back(std::move(ray)); });
  if (engine.failure.empty()) {
    const Tolerances tolerances = vecgeom_tolerances(world);
    for_all<EngineFigures>(
        made.size(), options.threads, [] { return EngineFigures{}; },
        [&](EngineFigures& figures, std::size_t i) {
          figures.add(world, rays[i], made[i],
                      judge_named_ray(reference, rays[i], made[i], tolerances));
        },
        [&](const EngineFigures& figures) { engine.figures.append(figures); });
    engine.failure = vecgeom.time(rays, options.repetitions, engine.ns_per_step);
    std::vector<LegEnd> ends;
    if (engine.failure.empty() && !track.legs.empty()) {
      engine.failure = vecgeom.follow(track, ends);
      engine.track = judge_track(world, track, ends);
    }
  }
  report.engines.push_back(std::move(engine));
}

}  // namespace

ExperimentReport run_experiment(const std::shared_ptr<const World>& world,
                                const ExperimentOptions& options) {
  const auto start = Clock::now();
  const reference::WideGeometry reference(world);
  const std::vector<Ray>& rays = options.rays;
  ExperimentReport report;
  std::vector<LevelEngine> levels;
  for (const NavigatorLevel& level : navigator_levels()) {
    levels.emplace_back(world, level, options.geometry);
    report.engines.emplace_back().name = level.name;
  }
  if (options.prepared) options.prepared();
  spdlog::debug("event=judging rays={}", rays.size());
  compare_levels(reference, levels, rays, options.threads, report);
  if (report.engines[0].figures.rays == 0) common::stop_if_interrupted();
  try {
    time_levels(levels, *world, rays, options.repetitions, report);
    Track track;
    if (options.boundaries > 0) {
      Navigator navigator = levels[0].runtime().navigator();
      track = make_track(reference, navigator, options.boundaries, options.seed);
    }
    for (std::size_t l = 0; l < levels.size(); ++l) {
      report.engines[l].scene_ns = time_scenes(levels[l], *world, rays);
      common::stop_if_interrupted();
      Navigator navigator = levels[l].runtime().navigator();
      report.engines[l].track = judge_track(*world, track, follow(navigator, *world, track));
    }
    if (options.vecgeom) add_vecgeom(reference, rays, track, options, report);
  } catch (const common::Interrupted&) {
    // What there is, is the report.
  }
  report.interrupted = interrupted();
  report.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return report;
}

}  // namespace navjit::accuracy
