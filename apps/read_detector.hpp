// How the subcommands read the detector that they are given.
#pragma once

#include <memory>
#include <string>

#include "geometry/model/world.hpp"

namespace navjit::apps {

/// Reads a GDML file and logs, a line each, what is odd in it. `setup`: as in GdmlOptions. Throws
/// GdmlError.
std::shared_ptr<const World> read_detector(const std::string& file, const std::string& setup);

}  // namespace navjit::apps
