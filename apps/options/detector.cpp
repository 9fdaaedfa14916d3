#include "apps/options/detector.hpp"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>

namespace navjit::apps {

void add_detector(CLI::App& command, Detector& detector) {
  command.add_option("detector", detector.file, "GDML file")->required();
  command.add_option("--setup", detector.setup, "which <setup> of the file (default: its default)")
      ->option_text("NAME");
}

std::shared_ptr<const World> read(const Detector& detector, GdmlReport& report) {
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
