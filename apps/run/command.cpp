// `navjit run`: transports rays, shows how it goes, and what specialisation won.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <thread>

#include "apps/commands.hpp"
#include "apps/options/detector.hpp"
#include "apps/options/numbers.hpp"
#include "apps/options/runtime.hpp"
#include "apps/options/source.hpp"
#include "apps/run/report.hpp"
#include "runtime/runtime.hpp"

namespace navjit::apps {
namespace {

struct Options {
  Detector detector;
  std::uint64_t rays = 100000;
  common::RaySource source;
  unsigned threads = 1;
  RuntimeOptions runtime;
  std::string report;        ///< JSON file; empty: none
  std::string save_profile;  ///< file for `navjit specialise`; empty: none
};

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Rays that a thread takes at a time. Sums are made per chunk and added in order, so that they do
/// not depend on the number of threads.
constexpr std::uint64_t rays_per_chunk = 64;

struct ChunkTotals {
  std::uint64_t steps = 0;
  std::uint64_t stuck = 0;
  double length = 0;
};

/// Counters that the progress line reads while threads work.
struct Progress {
  std::atomic<std::uint64_t> rays{0};
  std::atomic<std::uint64_t> steps{0};
  std::atomic<bool> done{false};
};

struct SceneCounts {
  std::size_t hot = 0, compiling = 0, swapped = 0;
};

SceneCounts count_scenes(const RuntimeReport& report) {
  SceneCounts counts;
  for (const SceneReport& scene : report.scenes) {
    counts.hot += scene.share >= 0.01 ? 1 : 0;
    counts.compiling += scene.status == SceneStatus::compiling ? 1 : 0;
    counts.swapped += scene.status == SceneStatus::specialised ? 1 : 0;
  }
  return counts;
}

void print_progress(const Progress& progress, std::uint64_t rays, const RuntimeReport& report,
                    double seconds, double steps_per_second, bool terminal) {
  const SceneCounts scenes = count_scenes(report);
  std::fprintf(stderr,
               "%s%6.1f s  %llu of %llu rays  %7.3f M steps/s  scenes: %zu hot, %zu compiling, "
               "%zu swapped%s",
               terminal ? "\r\033[K" : "", seconds,
               static_cast<unsigned long long>(progress.rays.load()),
               static_cast<unsigned long long>(rays), steps_per_second / 1e6, scenes.hot,
               scenes.compiling, scenes.swapped, terminal ? "" : "\n");
  std::fflush(stderr);
}

/// Watches until the run is done: the progress line, and when the last swap was.
struct Watch {
  double last_swap_s = 0;
  std::uint64_t steps_at_last_swap = 0;

  void follow(const Runtime& runtime, const Progress& progress, std::uint64_t rays,
              Clock::time_point start) {
    const bool terminal = isatty(STDERR_FILENO) != 0;
    const double interval = terminal ? 0.2 : 2.0;
    double shown = 0;
    std::uint64_t shown_steps = 0;
    std::size_t swapped = 0;
    while (!progress.done.load()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      const double t = seconds_since(start);
      const std::size_t now_swapped = runtime.specialised();
      if (now_swapped != swapped) {
        swapped = now_swapped;
        last_swap_s = t;
        steps_at_last_swap = progress.steps.load();
      }
      if (t - shown < interval) continue;
      const std::uint64_t steps = progress.steps.load();
      print_progress(progress, rays, runtime.report(), t,
                     static_cast<double>(steps - shown_steps) / (t - shown), terminal);
      shown = t;
      shown_steps = steps;
    }
    if (terminal) std::fputs("\r\033[K", stderr);
  }
};

/// What specialisation won, measured rather than estimated: the first rays of the run once more, in
/// turn with the navigators as they are now and with generic ones, for about half a second.
void compare_with_generic(Runtime& specialised, const Options& options, RunReport& report) {
  RuntimeOptions off = options.runtime;
  off.jit = JitMode::off;
  off.cache = {};
  off.plugin = {};
  Runtime generic(specialised.share_world(), off);
  Navigator with = specialised.navigator(), without = generic.navigator();
  const World& world = specialised.world();
  double seconds_with = 0, seconds_without = 0;
  std::uint64_t steps_with = 0, steps_without = 0;
  const auto timed = [&](Navigator& navigator, std::uint64_t first, std::uint64_t last,
                         double& seconds, std::uint64_t& steps) {
    const Clock::time_point start = Clock::now();
    for (std::uint64_t i = first; i < last; ++i) {
      steps += transport(navigator, make_ray(options.source, world, i), world.tolerance).steps;
    }
    seconds += seconds_since(start);
  };
  for (std::uint64_t first = 0; first < options.rays && seconds_with + seconds_without < 0.5;
       first += rays_per_chunk) {
    const std::uint64_t last = std::min(options.rays, first + rays_per_chunk);
    timed(with, first, last, seconds_with, steps_with);
    timed(without, first, last, seconds_without, steps_without);
    report.compared_rays = last;
  }
  if (steps_with > 0) {
    report.compared_with = static_cast<double>(steps_with) / seconds_with;
    report.compared_without = static_cast<double>(steps_without) / seconds_without;
  }
}

int run(const Options& options) {
  Runtime runtime(read(options.detector), options.runtime);
  const World& world = runtime.world();
  const std::uint64_t chunks = (options.rays + rays_per_chunk - 1) / rays_per_chunk;
  std::vector<ChunkTotals> totals(chunks);
  Progress progress;
  std::atomic<std::uint64_t> next{0};
  std::atomic<std::uint64_t> differences{0}, declined{0};
  const auto work = [&] {
    Navigator navigator = runtime.navigator();
    for (std::uint64_t c; (c = next.fetch_add(1)) < chunks;) {
      const std::uint64_t last = std::min(options.rays, (c + 1) * rays_per_chunk);
      for (std::uint64_t i = c * rays_per_chunk; i < last; ++i) {
        const RayTotals ray =
            transport(navigator, make_ray(options.source, world, i), world.tolerance);
        totals[c].steps += ray.steps;
        totals[c].length += ray.length;
        totals[c].stuck += ray.stuck ? 1 : 0;
      }
      progress.rays.fetch_add(last - c * rays_per_chunk, std::memory_order_relaxed);
      progress.steps.fetch_add(totals[c].steps, std::memory_order_relaxed);
    }
    differences += navigator.counts().differences;
    declined += navigator.counts().declined;
  };

  const Clock::time_point start = Clock::now();
  Watch watch;
  std::jthread watcher([&] { watch.follow(runtime, progress, options.rays, start); });
  std::vector<std::jthread> threads;
  for (unsigned t = 1; t < options.threads; ++t) threads.emplace_back(work);
  work();
  threads.clear();
  const double seconds = seconds_since(start);
  progress.done = true;
  watcher.join();

  RunReport report;
  report.detector = options.detector.file;
  report.rays = options.rays;
  report.threads = options.threads;
  report.jit = options.runtime.jit;
  report.level = options.runtime.level;
  report.budget = options.runtime.budget;
  for (const ChunkTotals& chunk : totals) {
    report.steps += chunk.steps;
    report.stuck += chunk.stuck;
    report.length_mm += chunk.length;
  }
  report.seconds = seconds;
  report.steps_per_second = static_cast<double>(report.steps) / seconds;
  // With --jit wait the swaps came before the run; and a run may end before, or just as, something
  // is swapped: then the whole run is what can be told.
  const bool measurable = options.runtime.jit != JitMode::wait &&
                          seconds > watch.last_swap_s + 0.01 &&
                          report.steps > watch.steps_at_last_swap;
  report.warm_steps_per_second =
      measurable ? static_cast<double>(report.steps - watch.steps_at_last_swap) /
                       (seconds - watch.last_swap_s)
                 : report.steps_per_second;
  report.declined = declined;
  report.differences = differences;
  report.runtime = runtime.final_report();
  if (count_scenes(report.runtime).swapped > 0 && options.runtime.jit != JitMode::shadow) {
    compare_with_generic(runtime, options, report);
  }
  print_table(report);
  if (!options.save_profile.empty()) write_profile(runtime.step_profile(), options.save_profile);
  if (!options.report.empty()) write_json(report, options.report);
  if (differences > 0) {
    throw std::runtime_error(std::to_string(differences.load()) +
                             " steps differed from the generic navigator's");
  }
  return 0;
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("run", "Transport rays with the JIT on");
  add_detector(command, options->detector);
  command
      .add_option("--budget", options->runtime.budget,
                  "how far from its surface a step may end: told scene by scene")
      ->check(CLI::PositiveNumber)
      ->option_text("MM");
  command.add_option("--rays", options->rays, "number of rays")->check(CLI::PositiveNumber);
  add_source(command, options->source);
  command.add_option("--report", options->report, "write a JSON report")->option_text("FILE");
  command.add_option("--save-profile", options->save_profile, "write what navjit specialise needs")
      ->option_text("FILE");
  add_threads(command, options->threads);
  add_runtime_options(command, options->runtime);
  command.callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace navjit::apps
