// `navjit warmup`: what the JIT costs before it pays, and what it pays.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/commands.hpp"
#include "apps/options/machine.hpp"
#include "apps/options/numbers.hpp"
#include "apps/options/outputs.hpp"
#include "apps/warmup/experiment.hpp"
#include "apps/warmup/one_run_options.hpp"
#include "apps/warmup/page.hpp"
#include "apps/warmup/picture.hpp"
#include "apps/warmup/report.hpp"
#include "common/gnuplot.hpp"
#include "common/interruption.hpp"
#include "jit/compiler.hpp"
#include "navjit/errors.hpp"

namespace navjit::apps {
namespace {

struct Options {
  warmup::RunSetup every;  ///< what all runs have in common
  /// The same as words of a command line, as far as it was given.
  std::vector<std::string> words, plugin_words;
  double seconds = 5;         ///< of a run
  double prime_seconds = 10;  ///< of the run that fills the cache
  int repetitions = 5;
  std::vector<std::string> modes{"cold", "cache", "plugin"};
  std::vector<int> optimisations{2};
  std::string report;   ///< JSON file; empty: none
  std::string csv;      ///< every point; empty: none
  std::string picture;  ///< SVG or PNG file; empty: none
  std::string html;     ///< page; empty: none
};

std::vector<warmup::Variant> variants_of(const Options& options) {
  using warmup::Mode;
  std::vector<warmup::Variant> variants{{"off", Mode::off, {}}};
  for (const int opt : options.optimisations) {
    for (const Mode mode : {Mode::cold, Mode::cache, Mode::plugin}) {
      const std::string name = warmup::mode_name(mode);
      if (std::find(options.modes.begin(), options.modes.end(), name) == options.modes.end()) {
        continue;
      }
      const std::string level = std::to_string(opt);
      const std::string suffix = options.optimisations.size() > 1 ? " -O" + level : "";
      variants.push_back({name + suffix, mode, {"--opt", level}});
    }
  }
  return variants;
}

/// A run keeps a point in memory and in its record for each interval. These are some 12 MB, of
/// the 16 MB that are read of a process (common/child.hpp).
constexpr double most_points = 200000;

void refuse_too_many_points(const Options& options) {
  const double seconds = std::max(options.seconds, options.prime_seconds);
  if (seconds / options.every.interval <= most_points * (1 + 1e-9)) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "a run of %g s would have more than %.0f points; give %g or more, or fewer seconds",
                seconds, most_points, std::ceil(seconds / most_points * 1e4) / 1e4);
  throw CLI::ValidationError("--interval", text);
}

/// Throws also if the same rays had different steps in different runs, and if a run failed.
int warmup(const Options& options) {
  if (!options.picture.empty()) common::check_picture(options.picture);
  Output json(options.report), csv(options.csv), picture(options.picture), page(options.html);
  const common::Interruptible interruptible;
  if (!jit::has_compiler()) {
    throw Error("this program was built without a compiler: nothing warms up");
  }
  // What is wrong with it is told at once.
  common::check_origin(options.every.source, read(options.every.detector));
  warmup::ExperimentOptions experiment;
  experiment.program = std::filesystem::read_symlink("/proc/self/exe");
  experiment.words = options.words;
  experiment.plugin_words = options.plugin_words;
  experiment.variants = variants_of(options);
  experiment.repetitions = options.repetitions;
  experiment.seconds = options.seconds;
  experiment.prime_seconds = options.prime_seconds;
  const warmup::ExperimentReport report = warmup::run_experiment(experiment);
  warmup::print_table(report);
  const auto make_json = [&] {
    nlohmann::ordered_json all = circumstances_json();
    all.update(nlohmann::ordered_json{{"detector", options.every.detector.file},
                                      {"threads", options.every.threads},
                                      {"seconds", options.seconds},
                                      {"repetitions", options.repetitions}});
    all.update(warmup::to_json(report));
    return report_text(all);
  };
  attempt_all(
      {[&] { json.write(make_json); }, [&] { csv.write([&] { return warmup::to_csv(report); }); },
       [&] {
         picture.write([&] {
           return warmup::draw(report,
                               std::filesystem::path(options.every.detector.file).filename(),
                               options.picture);
         });
       },
       [&] {
         page.write([&] {
           return warmup::page(report,
                               std::filesystem::path(options.every.detector.file).filename(),
                               circumstances());
         });
       }});
  if (!report.same_rays) throw Error("runs differ in the steps of the same rays");
  if (!report.failure.empty()) throw Error(report.failure);
  return 0;
}

}  // namespace

void add_warmup(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command =
      *app.add_subcommand("warmup", "What the JIT costs before it pays: steps/s against time");
  const std::vector<CLI::Option*> shared = warmup::add_shared_options(command, options->every);
  command.add_option("--seconds", options->seconds, "of each run (default: 5)")
      ->check(number(0.05, 3600.0))
      ->option_text("S");
  command
      .add_option(
          "--prime", options->prime_seconds,
          "seconds of the run that fills the cache and makes the\nplugin's profile (default: 10)")
      ->check(number(0.05, 3600.0))
      ->option_text("S");
  command.add_option("--repetitions", options->repetitions, "of each run, in turn (default: 5)")
      ->transform(count(1, 1000))
      ->option_text("N");
  command
      .add_option("--modes", options->modes,
                  "of cold, cache and plugin (default: all); off is always\nthere")
      ->delimiter(',')
      ->check(one_of({"cold", "cache", "plugin"}))
      ->option_text("LIST");
  command
      .add_option("--opt", options->optimisations,
                  "compiler's optimisations to compare (default: 2)")
      ->delimiter(',')
      ->transform(count(0, 3))
      ->option_text("LIST");
  add_output(command, "--report", options->report, "write a JSON report");
  add_output(command, "--csv", options->csv, "write every point");
  add_plot(command, "--picture", options->picture, "speed and share against time; by gnuplot");
  add_output(command, "--html", options->html, "write a page for people");
  command.callback([options, shared, &action] {
    refuse_too_many_points(*options);
    refuse_same_files({{"--report", options->report},
                       {"--csv", options->csv},
                       {"--picture", options->picture},
                       {"--html", options->html}},
                      {{"the detector", options->every.detector.file}});
    options->words = warmup::words_given(shared);
    options->plugin_words = warmup::words_given(warmup::options_of_plugins(shared));
    action = [options] { return warmup(*options); };
  });
}

}  // namespace navjit::apps
