// `navjit run`: transports rays, shows how it goes, and what specialisation won.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>

#include "apps/commands.hpp"
#include "apps/mpi/processes.hpp"
#include "apps/options/basket.hpp"
#include "apps/options/detector.hpp"
#include "apps/options/numbers.hpp"
#include "apps/options/observe.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/runtime.hpp"
#include "apps/options/source.hpp"
#include "apps/run/merge.hpp"
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
  std::optional<common::Part> part;
  unsigned threads = 1;
  std::size_t basket = 0;  ///< 0: rays one by one
  Observation observation;
  RuntimeOptions runtime;
  std::string report;        ///< JSON file; empty: none
  std::string html;          ///< page; empty: none
  std::string save_profile;  ///< file for `navjit specialise`; empty: none
};

/// The comparison takes a quarter of the run's time, but no less and no more than so many s.
constexpr double shortest_comparison = 0.1, longest_comparison = 3;

/// What a run needs before it begins, and what it writes at its end.
struct Run {
  explicit Run(const Options& options)
      : profile(options.save_profile),
        json(options.report),
        page(options.html),
        world(checked(options)),
        rays(options.rays.rays, options.rays.source, *world, options.part.value_or(common::Part{})),
        seen(world, options.observation),
        own_seen((log_observation(seen), thread_seconds())),
        runtime(seen.detector(), options.runtime) {
    // With --jit wait this thread has compiled since the runtime was begun.
    own_made = (options.runtime.jit == JitMode::wait ? own_seen : thread_seconds()) - own_begun;
  }
  static std::shared_ptr<const World> checked(const Options& options) {
    auto world = read(options.detector);
    common::check_origin(options.rays.source, world);
    return world;
  }

  Output profile, json, page;
  std::shared_ptr<const World> world;
  common::RayStream rays;
  double all_begun = process_seconds(), own_begun = thread_seconds(), own_made = 0;
  ObservedDetector seen;
  double own_seen;
  Runtime runtime;
};

/// Transports the rays.
RunReport made_by(Run& all, const Options& options, const std::atomic<bool>& in_vain) {
  RunReport report;
  report.transport =
      transport_rays(all.runtime, all.seen, all.rays, options.threads, options.basket, in_vain);
  const Transport& made = report.transport;
  if (options.runtime.jit != JitMode::off) {
    report.compile_cpu_seconds = std::max(0.0, process_seconds() - all.all_begun - all.own_made -
                                                   made.cpu_seconds - made.watch_seconds);
  }
  report.interrupted = common::interruption() != 0;
  report.detector = options.detector.file;
  report.seen = &all.seen;
  report.part = options.part.value_or(common::Part{});
  report.rays_of = text_of(options.rays);
  report.basket = options.basket;
  report.jit = options.runtime.jit;
  report.budget = options.runtime.budget;
  const bool in_haste = report.interrupted || in_vain;
  report.runtime = all.runtime.final_report(in_haste ? 0 : 1);
  if (report.any_specialised() && !in_haste && options.runtime.jit != JitMode::shadow) {
    const double seconds = std::clamp(made.seconds / 4, shortest_comparison, longest_comparison);
    report.compared = compare_with_generic(all.runtime, all.seen, options.runtime, made.first_rays,
                                           seconds, options.basket);
  }
  return report;
}

/// Tells and writes it.
void tell(Run& all, const Options& options, const RunReport& report, const StepProfile& profile) {
  std::string hot_map;
  if (all.page && !report.interrupted) {
    hot_map = hot_map_of(all.runtime, options.runtime, options.threads);
  }
  print_table(report);
  attempt_all({[&] { all.profile.write([&] { return profile_text(profile); }); },
               [&] { all.json.write([&] { return json_text(report); }); },
               [&] { all.page.write([&] { return run_page(report, hot_map); }); }});
  if (report.transport.differences > 0) {
    throw Error(std::to_string(report.transport.differences) +
                " steps differed from the generic navigator's");
  }
}

/// The same options for one process of several: its part, and what the first alone writes.
Options share_of(const Processes& processes, Options options) {
  if (!processes.several()) return options;
  options.part = {processes.rank() + 1, processes.count()};
  if (!processes.first()) {
    options.report.clear();
    options.html.clear();
    options.save_profile.clear();
  }
  return options;
}

int run(const Options& asked) {
  // A part that is asked for is a run of its own.
  Processes processes(asked.part ? nullptr : Processes::of_launcher());
  const Options options = share_of(processes, asked);
  std::optional<Run> all;
  processes.together([&] { all.emplace(options); });
  const common::Interruptible interruptible;
  RunReport report;
  StepProfile profile;
  processes.together([&] {
    report = made_by(*all, options, processes.in_vain());
    profile = all->runtime.step_profile();
  });
  Made made;
  if (processes.several()) made = gather(processes, report, profile);
  processes.together([&] {
    if (!processes.first()) return;
    if (processes.several()) merge(made, report, profile);
    tell(*all, options, report, profile);
  });
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
  add_output(command, "--report", options->report, "write a JSON report");
  add_output(command, "--html", options->html, "write a page for people");
  add_output(command, "--save-profile", options->save_profile,
             "write what navjit specialise needs");
  add_threads(command, options->threads);
  add_observe(command, options->observation);
  add_basket(command, options->basket);
  add_runtime_options(command, options->runtime);
  command.callback([options, &action] {
    refuse_same_files({{"--report", options->report},
                       {"--html", options->html},
                       {"--save-profile", options->save_profile}},
                      {{"the detector", options->detector.file},
                       {"--rays", options->rays.file()},
                       {"--plugin", options->runtime.plugin}});
    action = [options] { return run(*options); };
  });
}

}  // namespace navjit::apps
