#include "apps/options/detector.hpp"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>

#include "apps/options/numbers.hpp"
#include "navjit/root.hpp"

namespace navjit::apps {

void add_detector(CLI::App& command, Detector& detector) {
  command.add_option("detector", detector.file, "GDML file, or ROOT file with a TGeoManager")
      ->required();
  command
      .add_option("--setup", detector.setup,
                  "which <setup> of the file, or which TGeoManager (default: its default)")
      ->check(not_empty())
      ->option_text("NAME");
}

std::shared_ptr<const World> read(const Detector& detector, GdmlReport& report) {
  if (is_root_file(detector.file)) {
    return read_root(detector.file, {.key = detector.setup}, &report).model();
  }
  return std::make_shared<const World>(
      read_world(detector.file, {.setup = detector.setup}, &report));
}

std::shared_ptr<const World> read(const Detector& detector) {
  GdmlReport report;
  auto world = read(detector, report);
  for (const std::string& note : report.notes) spdlog::warn("{}", note);
  return world;
}

}  // namespace navjit::apps
