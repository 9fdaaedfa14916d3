// `navjit run`: transports rays, shows how it goes, and what specialisation won.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "apps/commands.hpp"
#include "apps/options/basket.hpp"
#include "apps/options/detector.hpp"
#include "apps/options/numbers.hpp"
#include "apps/options/observe.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/runtime.hpp"
#include "apps/options/source.hpp"
#include "apps/run/page.hpp"
#include "apps/run/report.hpp"
#include "common/interruption.hpp"
#include "navjit/errors.hpp"
#include "navjit/runtime.hpp"
#include "runtime/processor_time.hpp"

namespace navjit::apps {
namespace {

struct Options {
  Detector detector;
  RayOptions rays{.rays = "100000"};
  common::Part part;
  unsigned threads = 1;
  std::size_t basket = 0;  ///< 0: rays one by one
  Observation observation;
  RuntimeOptions runtime;
  std::string report;        ///< JSON file; empty: none
  std::string html;          ///< page; empty: none
  std::string save_profile;  ///< file for `navjit specialise`; empty: none
};

/// The comparison takes a quarter of the run's time at the most, and no longer than so many s.
constexpr double longest_comparison = 3;

int run(const Options& options) {
  Output profile(options.save_profile), json(options.report), page(options.html);
  const auto world = read(options.detector);
  common::check_origin(options.rays.source, world);
  common::RayStream rays(options.rays.rays, options.rays.source, *world, options.part);
  const double all_begun = process_seconds(), own_begun = thread_seconds();
  const ObservedDetector seen(world, options.observation);
  log_observation(seen);
  Runtime runtime(seen.detector(), options.runtime);
  // With --jit wait this thread has compiled.
  const double own_made = options.runtime.jit == JitMode::wait ? 0 : thread_seconds() - own_begun;
  const common::Interruptible interruptible;

  RunReport report;
  report.transport = transport_rays(runtime, seen, rays, options.threads, options.basket);
  const Transport& made = report.transport;
  if (options.runtime.jit != JitMode::off) {
    report.compile_cpu_seconds = std::max(
        0.0, process_seconds() - all_begun - own_made - made.cpu_seconds - made.watch_seconds);
  }
  report.interrupted = common::interruption() != 0;
  report.detector = options.detector.file;
  report.seen = &seen;
  report.part = options.part;
  report.basket = options.basket;
  report.jit = options.runtime.jit;
  report.budget = options.runtime.budget;
  report.runtime = runtime.final_report(report.interrupted ? 0 : 1);
  if (report.any_specialised() && !report.interrupted && options.runtime.jit != JitMode::shadow) {
    const double seconds = std::clamp(made.seconds / 4, 0.02, longest_comparison);
    report.compared = compare_with_generic(runtime, seen, options.runtime, made.first_rays, seconds,
                                           options.basket);
  }
  std::string hot_map;
  if (page && !report.interrupted) hot_map = hot_map_of(runtime, options.runtime, options.threads);
  print_table(report);
  attempt_all({[&] { profile.write([&] { return profile_text(runtime.step_profile()); }); },
               [&] { json.write([&] { return json_text(report); }); },
               [&] { page.write([&] { return run_page(report, hot_map); }); }});
  if (made.differences > 0) {
    throw Error(std::to_string(made.differences) + " steps differed from the generic navigator's");
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
  add_rays(command, options->rays);
  add_part(command, options->part);
  command.add_option("--report", options->report, "write a JSON report")->option_text("FILE");
  command.add_option("--html", options->html, "write a page for people")->option_text("FILE");
  command.add_option("--save-profile", options->save_profile, "write what navjit specialise needs")
      ->option_text("FILE");
  add_threads(command, options->threads);
  add_observe(command, options->observation);
  add_basket(command, options->basket);
  add_runtime_options(command, options->runtime);
  command.callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace navjit::apps
