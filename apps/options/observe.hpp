// --observe: which boundaries a run wants to see.
#pragma once

#include "navjit/observation.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace navjit::apps {

CLI::Option* add_observe(CLI::App& command, Observation& observation);

/// Each volume that was dissolved or left, at the level of decisions.
void log_observation(const ObservedDetector& seen);

}  // namespace navjit::apps
