#include "apps/options/observe.hpp"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>

#include "navjit/errors.hpp"

namespace navjit::apps {

CLI::Option* add_observe(CLI::App& command, Observation& observation) {
  return command
      .add_option_function<std::string>(
          "--observe",
          [&observation](const std::string& text) {
            try {
              observation = parse_observation(text);
            } catch (const UsageError& error) {
              throw CLI::ValidationError("--observe", error.what());
            }
          },
          "where steps end: all boundaries, or those of materials,\nregions and volumes that "
          "count, or those that change any ray by more than E, or\nthose left by mixtures that "
          "change a mean ray by E; E\nin radiation lengths, g/cm2 or %")
      ->option_text("all|materials|budget:E|mixtures:E[,VOLUME...]");
}

void log_observation(const ObservedDetector& seen) {
  const ObservationReport& report = seen.report();
  for (const ObservationReport::Entry& entry : report.gone) {
    spdlog::debug("event=dissolved volume={} mother={} placements={}", entry.volume, entry.mother,
                  entry.placements);
  }
  for (const ObservationReport::Entry& entry : report.left) {
    spdlog::debug("event=left volume={} mother={} placements={} why=\"{}\"", entry.volume,
                  entry.mother, entry.placements, entry.why);
  }
}

}  // namespace navjit::apps
