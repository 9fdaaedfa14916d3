// `navjit accuracy`: what each way of navigating costs, and how wrong it is.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/accuracy/experiment.hpp"
#include "apps/accuracy/observed_report.hpp"
#include "apps/accuracy/page.hpp"
#include "apps/accuracy/picture.hpp"
#include "apps/accuracy/report.hpp"
#include "apps/commands.hpp"
#include "apps/options/boxes.hpp"
#include "apps/options/detector.hpp"
#include "apps/options/machine.hpp"
#include "apps/options/numbers.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/source.hpp"
#include "common/gnuplot.hpp"
#include "common/interruption.hpp"
#include "common/text.hpp"
#include "navjit/errors.hpp"
#include "navjit/observation.hpp"

namespace navjit::apps {
namespace {

struct Options {
  Detector detector;
  RayOptions rays{.rays = "1000"};
  unsigned threads = 1;
  int repetitions = 5;
  std::uint64_t boundaries = 100000;  ///< of the long track
  std::size_t scenes = 12;            ///< in the table; the report has all
  GeometryOptions geometry;
  std::vector<std::string> observations;  ///< what is compared with `all`; empty: levels are judged
  std::string report;                     ///< JSON file; empty: none
  std::string html;                       ///< page; empty: none
  std::string picture;                    ///< SVG or PNG file; empty: none
  std::string vecgeom;                    ///< vecgeom_trace; empty: beside navjit; "off": without
  std::string vecgeom_detector;           ///< the detector as VecGeom can read it; empty: the same
  std::string vecgeom_navigator = "automatic";
  double vecgeom_seconds = 300;  ///< for each of its runs
};

std::string title_of(const Options& options) {
  return std::filesystem::path(options.detector.file).filename();
}

/// How VecGeom is called; nothing where it is not asked, or not there, which is said.
std::optional<accuracy::VecGeom::Options> vecgeom_of(const Options& options) {
  if (options.vecgeom == "off") return std::nullopt;
  const std::optional<std::string> program = options.vecgeom.empty()
                                                 ? accuracy::VecGeom::beside_this_program()
                                                 : std::optional(options.vecgeom);
  if (!program) {
    std::fprintf(stderr, "navjit: without VecGeom: there is no vecgeom_trace beside navjit\n");
    return std::nullopt;
  }
  if (access(program->c_str(), X_OK) != 0) {
    throw Error("--vecgeom " + common::printable(*program) +
                ": there is no such program; name vecgeom_trace, or give off");
  }
  const std::string& detector =
      options.vecgeom_detector.empty() ? options.detector.file : options.vecgeom_detector;
  return accuracy::VecGeom::Options{*program, detector, options.vecgeom_navigator,
                                    options.vecgeom_seconds};
}

/// Exit status 1 if a ray changes by more than is promised.
int compare_observed(const Options& options) {
  if (!options.picture.empty()) common::check_picture(options.picture);
  std::vector<Observation> observations;
  for (const std::string& text : options.observations) {
    observations.push_back(parse_observation(text));
  }
  Output json(options.report), picture(options.picture), page(options.html);
  std::optional<common::Interruptible> interruptible;  // once there may be something to write
  const auto world = read(options.detector);
  common::check_origin(options.rays.source, world);
  const auto rays = common::rays_of(options.rays.rays, options.rays.source, *world);
  if (rays.empty()) throw Error("no rays are asked for; at least one is needed");
  const auto figures =
      accuracy::compare_observations(world, observations, rays, options.repetitions,
                                     vecgeom_of(options), [&] { interruptible.emplace(); });
  accuracy::print(figures);
  attempt_all(
      {[&] {
         json.write([&] {
           nlohmann::ordered_json report = circumstances_json();
           report.update(nlohmann::ordered_json{{"detector", options.detector.file},
                                                {"rays", rays.size()},
                                                {"observations", accuracy::to_json(figures)}});
           return report_text(report);
         });
       },
       [&] {
         picture.write([&] { return accuracy::draw(figures, title_of(options), options.picture); });
       },
       [&] {
         page.write([&] { return accuracy::page(figures, title_of(options), circumstances()); });
       }});
  return accuracy::any_beyond(figures) ? 1 : 0;
}

/// Exit status 1 if one of navjit's own levels is wrong anywhere.
int accuracy(const Options& options) {
  if (!options.picture.empty()) common::check_picture(options.picture);
  Output json(options.report), picture(options.picture), page(options.html);
  std::optional<common::Interruptible> interruptible;  // once there may be something to write
  const auto world = read(options.detector);
  common::check_origin(options.rays.source, world);
  accuracy::ExperimentOptions experiment;
  experiment.rays = common::rays_of(options.rays.rays, options.rays.source, *world);
  if (experiment.rays.empty()) throw Error("no rays are asked for; at least one is needed");
  experiment.seed = options.rays.source.seed;
  experiment.threads = options.threads;
  experiment.repetitions = options.repetitions;
  experiment.boundaries = options.boundaries;
  experiment.geometry = options.geometry;
  experiment.vecgeom = vecgeom_of(options);
  experiment.prepared = [&] { interruptible.emplace(); };
  const accuracy::ExperimentReport report = accuracy::run_experiment(world, experiment);
  accuracy::print_tables(*world, report, options.scenes);
  attempt_all(
      {[&] {
         json.write([&] {
           nlohmann::ordered_json all = circumstances_json();
           all.update(accuracy::to_json(*world, options.detector.file, report));
           return report_text(all);
         });
       },
       [&] {
         page.write(
             [&] { return accuracy::page(*world, report, title_of(options), circumstances()); });
       },
       [&] {
         // A signal may have come before there was anything to draw.
         if (report.interrupted && !accuracy::can_be_drawn(report)) return;
         picture.write([&] { return accuracy::draw(report, title_of(options), options.picture); });
       }});
  // The levels of navjit have to be right; how VecGeom fares is a result.
  for (const accuracy::EngineReport& engine : report.engines) {
    if (engine.name == "VecGeom") continue;
    const accuracy::EngineFigures& f = engine.figures;
    if (f.stuck + f.lost + f.all.wrong_volume + f.all.wrong_end + f.beyond_bound > 0) return 1;
    if (engine.name == "exact" && f.equal != f.made) return 1;
  }
  return 0;
}

}  // namespace

void add_accuracy(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand(
      "accuracy", "Hold every step against 113 bits: errors, and speed beside VecGeom's");
  add_detector(command, options->detector);
  add_rays(command, options->rays);
  command
      .add_option("--repetitions", options->repetitions,
                  "of the timing (default: 5); 0, with --observe alone: none")
      ->transform(count(0, 1000));
  command
      .add_option("--boundaries", options->boundaries,
                  "on the long track (default: 100000); 0: none")
      ->transform(count(0));
  command.add_option("--scenes", options->scenes, "in the table (default: 12)")
      ->transform(count(0));
  add_output(command, "--report", options->report, "write a JSON report");
  add_output(command, "--html", options->html, "write a page for people");
  add_plot(command, "--picture", options->picture, "speed against error; by gnuplot");
  command
      .add_option("--vecgeom", options->vecgeom,
                  "the program vecgeom_trace, or off (default: the one\nbeside navjit)")
      ->option_text("PROGRAM|off");
  command
      .add_option("--vecgeom-detector", options->vecgeom_detector,
                  "the same detector, as VecGeom can read it")
      ->option_text("FILE");
  command.add_option("--vecgeom-navigator", options->vecgeom_navigator, "of VecGeom")
      ->check(one_of({"simple", "abbox", "hybrid", "bvh", "automatic"}))
      ->option_text("NAME");
  command
      .add_option("--vecgeom-seconds", options->vecgeom_seconds,
                  "for each of its runs (default: 300)")
      ->check(number_above(0, 1e6))
      ->option_text("S");
  command
      .add_option("--observe", options->observations,
                  "compare what is observed with all, and judge no steps;\nseveral may be given")
      ->check([](const std::string& text) {
        try {
          parse_observation(text);
          return std::string();
        } catch (const UsageError& error) {
          return std::string(error.what());
        }
      })
      ->option_text("materials|budget:E|mixtures:E[,VOLUME...] ...");
  add_threads(command, options->threads);
  add_boxes(command, options->geometry);
  command.callback([options, &action] {
    refuse_same_files(
        {{"--report", options->report}, {"--html", options->html}, {"--picture", options->picture}},
        {{"the detector", options->detector.file},
         {"--rays", options->rays.file()},
         {"--vecgeom-detector", options->vecgeom_detector}});
    if (options->repetitions == 0 && options->observations.empty()) {
      throw CLI::ValidationError("--repetitions", "'0' is less than 1, and here steps are timed");
    }
    action = [options] {
      return options->observations.empty() ? accuracy(*options) : compare_observed(*options);
    };
  });
}

}  // namespace navjit::apps
