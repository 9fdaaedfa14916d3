// `navjit scan`: material budget against pseudorapidity and azimuth.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "apps/commands.hpp"
#include "apps/options/detector.hpp"
#include "apps/options/numbers.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/runtime.hpp"
#include "apps/options/source.hpp"
#include "apps/scan/report.hpp"
#include "common/gnuplot.hpp"
#include "common/progress_line.hpp"
#include "common/rays.hpp"

namespace navjit::apps {
namespace {

using scan::Quantity;

struct Options {
  Detector detector;
  scan::Request request;
  Quantity quantity = Quantity::radiation_lengths;
  Cache cache;
  std::string csv, picture;
};

const common::Choices<Quantity> quantities{{"x0", Quantity::radiation_lengths},
                                           {"mass", Quantity::mass},
                                           {"lambda", Quantity::interaction_lengths}};

int look(const Options& options) {
  if (!options.picture.empty()) common::check_picture(options.picture);
  Output csv(options.csv), picture(options.picture);
  const auto world = read(options.detector);
  common::check_origin({.origin = options.request.origin}, world);
  RuntimeOptions runtime_options{.cache = options.cache};
  runtime_options.specialiser.safety = false;
  Runtime runtime(world, runtime_options);
  scan::Scan made;
  {
    common::ProgressLine line("scan", static_cast<std::uint64_t>(options.request.eta_bins));
    scan::Request request = options.request;
    request.progress = [&](int bins) { line.at(static_cast<std::uint64_t>(bins)); };
    made = scan::make(runtime, request);
  }
  std::fputs(scan::table_text(made, *world, options.quantity).c_str(), stdout);
  std::printf("\n%llu rays, %llu stuck\n", static_cast<unsigned long long>(made.rays),
              static_cast<unsigned long long>(made.stuck));
  attempt_all({[&] { csv.write([&] { return scan::csv_text(made); }); },
               [&] {
                 picture.write([&] {
                   return scan::draw(made, *world, options.quantity, options.detector.file,
                                     options.picture);
                 });
               }});
  return 0;
}

void add_range(CLI::App& command, const std::string& name, scan::Range& range, double most,
               const std::string& what) {
  command
      .add_option_function<std::string>(
          name,
          [name, most, &range](const std::string& text) {
            const std::vector<double> v = numbers(name, text, 2);
            if (!(v[0] < v[1]) || v[0] < -most || v[1] > most) {
              throw CLI::ValidationError(name,
                                         "'" + text + "' is not a range from low to high, within " +
                                             std::to_string(static_cast<int>(most)) + " of 0");
            }
            range = {v[0], v[1]};
          },
          what)
      ->option_text("LO,HI");
}

}  // namespace

void add_scan(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("scan", "Sum up material along rays from a point");
  add_detector(command, options->detector);
  scan::Request& request = options->request;
  command
      .add_option_function<std::string>(
          "--origin",
          [&request](const std::string& text) {
            const std::vector<double> v = numbers("--origin", text, 3);
            request.origin = {v[0], v[1], v[2]};
          },
          "start of all rays, mm (default: 0,0,0)")
      ->option_text("X,Y,Z");
  add_range(command, "--eta", request.eta, largest_eta, "pseudorapidity about +z (default: -3,3)");
  add_range(command, "--phi", request.phi, 1000, "azimuth, rad (default: all of it)");
  command.add_option("--eta-bins", request.eta_bins, "(default: 30)")
      ->transform(count(1, 10000))
      ->option_text("N");
  command.add_option("--phi-bins", request.phi_bins, "(default: 72)")
      ->transform(count(1, 10000))
      ->option_text("N");
  command
      .add_option("--rays", request.rays,
                  "in each bin along either of its sides, N times N in all (default: 4)")
      ->transform(count(1, 1000))
      ->option_text("N");
  command.add_option("--stop", request.stop, "volumes at which rays end (* and ? are any)")
      ->allow_extra_args(false)
      ->option_text("NAME");
  add_choice(command, "--of", options->quantity, quantities,
             "what table and picture show: x0, mass (g/cm2) or lambda (interaction lengths)")
      ->option_text("WHAT");
  add_output(command, "--csv", options->csv, "write every bin");
  add_plot(command, "--picture", options->picture, "of the sums; by gnuplot");
  add_threads(command, request.threads);
  add_cache_option(command, options->cache, true);
  command.callback([options, &action] {
    refuse_same_files({{"--csv", options->csv}, {"--picture", options->picture}},
                      {{"the detector", options->detector.file}});
    action = [options] { return look(*options); };
  });
}

}  // namespace navjit::apps
