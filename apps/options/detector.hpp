// Which detector a command is about, and of which of the file's setups.
#pragma once

#include <memory>
#include <string>

#include "geometry/gdml/read_world.hpp"

namespace CLI {
class App;
}

namespace navjit::apps {

struct Detector {
  std::string file;   ///< GDML
  std::string setup;  ///< of the file; empty: its default
};

void add_detector(CLI::App& command, Detector& detector);

/// Reads the detector. What is odd in it is logged, a line each; or it is put into a report, for a
/// command that does something else with it. Throws GdmlError.
std::shared_ptr<const World> read(const Detector& detector);
std::shared_ptr<const World> read(const Detector& detector, GdmlReport& report);

}  // namespace navjit::apps
