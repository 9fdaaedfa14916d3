// `navjit run`: transports rays, shows how it goes, and what specialisation won.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "apps/commands.hpp"
#include "apps/options/detector.hpp"
#include "apps/options/numbers.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/runtime.hpp"
#include "apps/options/source.hpp"
#include "apps/run/progress.hpp"
#include "apps/run/report.hpp"
#include "common/interruption.hpp"
#include "common/parallel.hpp"
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
  std::uint64_t rays = 0;
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
    counts.swapped += scene.binding != Binding::generic ? 1 : 0;
  }
  return counts;
}

/// Watches until the run is done: the progress line, and when the last swap was.
struct Watch {
  double last_swap_s = 0;
  std::uint64_t steps_at_last_swap = 0;

  void follow(const Runtime& runtime, const Progress& progress, std::uint64_t rays,
              Clock::time_point start) {
    const bool terminal = terminal_columns() > 0;
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
      if (!terminal || t - shown < 0.2) continue;
      const std::uint64_t steps = progress.steps.load();
      const SceneCounts scenes = count_scenes(runtime.report());
      const std::string line = progress_line(
          {t, progress.rays.load(), rays, static_cast<double>(steps - shown_steps) / (t - shown),
           scenes.hot, scenes.compiling, scenes.swapped},
          terminal_columns());
      std::fprintf(stderr, "\r\033[K%s", line.c_str());
      std::fflush(stderr);
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
  Output profile(options.save_profile), json(options.report);
  const auto detector = read(options.detector);
  common::check_origin(options.source, detector);
  Runtime runtime(detector, options.runtime);
  const common::Interruptible interruptible;
  const World& world = runtime.world();
  const std::uint64_t chunks = (options.rays + rays_per_chunk - 1) / rays_per_chunk;
  std::vector<ChunkTotals> totals(chunks);
  Progress progress;
  std::atomic<std::uint64_t> next{0};
  std::atomic<bool> stop{false};
  std::atomic<std::uint64_t> differences{0}, declined{0};
  const auto work = [&] {
    Navigator navigator = runtime.navigator();
    for (std::uint64_t c; !stop && (c = next.fetch_add(1)) < chunks;) {
      const std::uint64_t last = std::min(options.rays, (c + 1) * rays_per_chunk);
      for (std::uint64_t i = c * rays_per_chunk; i < last && common::interruption() == 0; ++i) {
        const RayTotals ray =
            transport(navigator, make_ray(options.source, world, i), world.tolerance);
        totals[c].steps += ray.steps;
        totals[c].length += ray.length;
        totals[c].stuck += ray.stuck ? 1 : 0;
        ++totals[c].rays;
      }
      stop = stop || common::interruption() != 0;
      progress.rays.fetch_add(totals[c].rays, std::memory_order_relaxed);
      progress.steps.fetch_add(totals[c].steps, std::memory_order_relaxed);
    }
    differences += navigator.counts().differences;
    declined += navigator.counts().declined;
  };

  const Clock::time_point start = Clock::now();
  Watch watch;
  std::jthread watcher;
  try {
    watcher = std::jthread([&] { watch.follow(runtime, progress, options.rays, start); });
  } catch (const std::system_error&) {
    // A run that nobody watches is a run all the same; whether there are threads to navigate on
    // is said below.
  }
  {
    // The watcher has to end also where the transport fails.
    struct Done {
      std::atomic<bool>& flag;
      ~Done() { flag = true; }
    } const done{progress.done};
    common::in_parallel(options.threads, stop, work);
  }
  const double seconds = seconds_since(start);
  if (watcher.joinable()) watcher.join();

  RunReport report;
  report.detector = options.detector.file;
  report.threads = options.threads;
  report.jit = options.runtime.jit;
  report.level = options.runtime.level;
  report.budget = options.runtime.budget;
  for (const ChunkTotals& chunk : totals) {
    report.rays += chunk.rays;
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
  if (common::interruption() == 0 && count_scenes(report.runtime).swapped > 0 &&
      options.runtime.jit != JitMode::shadow) {
    compare_with_generic(runtime, options, report);
  }
  print_table(report);
  attempt_all({[&] { profile.write([&] { return profile_text(runtime.step_profile()); }); },
               [&] { json.write([&] { return json_text(report); }); }});
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
      ->check(number_above(0, 1e12))
      ->option_text("MM");
  command.add_option("--rays", options->rays, "number of rays")->transform(count());
  add_source(command, options->source);
  command.add_option("--report", options->report, "write a JSON report")->option_text("FILE");
  command.add_option("--save-profile", options->save_profile, "write what navjit specialise needs")
      ->option_text("FILE");
  add_threads(command, options->threads);
  add_runtime_options(command, options->runtime);
  command.callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace navjit::apps
