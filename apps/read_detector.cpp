#include "apps/read_detector.hpp"

#include <spdlog/spdlog.h>

#include "geometry/gdml/reader.hpp"

namespace navjit::apps {

std::shared_ptr<const World> read_detector(const std::string& file, const std::string& setup) {
  GdmlReport report;
  auto world = std::make_shared<const World>(read_gdml(file, {.setup = setup}, &report));
  for (const std::string& note : report.notes) spdlog::warn("{}", note);
  return world;
}

}  // namespace navjit::apps
