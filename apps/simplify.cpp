// `navjit simplify`: the detector without what a run does not observe, as GDML for any program.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/commands.hpp"
#include "apps/options/detector.hpp"
#include "apps/options/machine.hpp"
#include "apps/options/observe.hpp"
#include "apps/options/observed_report.hpp"
#include "apps/options/outputs.hpp"
#include "common/text.hpp"
#include "navjit/gdml.hpp"
#include "navjit/version.hpp"

namespace navjit::apps {
namespace {

struct Options {
  Detector detector;
  Observation observation{.kind = Observation::Kind::materials};
  std::string out;
  std::string report;  ///< JSON file; empty: none
};

void print_entries(const Observation& observation,
                   const std::vector<ObservationReport::Entry>& entries, const char* what) {
  for (const ObservationReport::Entry& e : entries) {
    std::string bound;
    if (e.bound > 0) bound = "; at most " + bound_text(observation, e.bound) + " of any ray";
    std::printf("%s %s in %s: %llu placement%s%s%s%s\n", what, common::printable(e.volume).c_str(),
                common::printable(e.mother).c_str(), static_cast<unsigned long long>(e.placements),
                e.placements == 1 ? "" : "s", bound.c_str(), e.why.empty() ? "" : "; ",
                e.why.c_str());
  }
}

void print_mixtures(const ObservationReport& report) {
  for (const ObservationReport::Mixture& m : report.mixtures) {
    std::string names;
    for (const std::string& name : m.of) names += (names.empty() ? "" : ", ") + name;
    std::printf("homogenised %s: %llu placement%s of %s; %.6g g/cm3, %.6g mm a radiation length\n",
                common::printable(m.volume).c_str(), static_cast<unsigned long long>(m.placements),
                m.placements == 1 ? "" : "s", common::printable(names).c_str(), m.density,
                m.radiation_length);
  }
}

int simplify(const Options& options) {
  Output out(options.out), report(options.report);
  const ObservedDetector seen(read(options.detector), options.observation);
  const ObservationReport& r = seen.report();
  print_mixtures(r);
  print_entries(options.observation, r.gone, "dissolved");
  print_entries(options.observation, r.left, "left");
  std::printf("%llu placements, %llu before; %llu touchables, %llu before\n",
              static_cast<unsigned long long>(r.placements_after),
              static_cast<unsigned long long>(r.placements_before),
              static_cast<unsigned long long>(r.touchables_after),
              static_cast<unsigned long long>(r.touchables_before));
  print_observation(seen);
  attempt_all({[&] { out.write([&] { return gdml_text(seen.detector()); }); },
               [&] {
                 report.write([&] {
                   const nlohmann::ordered_json json{{"version", version()},
                                                     {"detector", options.detector.file},
                                                     {"observe", to_json(seen)}};
                   return report_text(json);
                 });
               }});
  return 0;
}

}  // namespace

void add_simplify(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command =
      *app.add_subcommand("simplify", "Write the detector without what is not observed");
  add_detector(command, options->detector);
  add_observe(command, options->observation)
      ->option_text("all|materials|budget:E|mixtures:E[,VOLUME...] (default: materials)");
  add_output(command, "-o,--out", options->out, "GDML file")->required();
  add_output(command, "--report", options->report, "write a JSON report");
  command.callback([options, &action] {
    refuse_same_files({{"-o", options->out}, {"--report", options->report}},
                      {{"the detector", options->detector.file}});
    action = [options] { return simplify(*options); };
  });
}

}  // namespace navjit::apps
