// --observe: which boundaries a run wants to see.
#pragma once

#include "navjit/observation.hpp"

namespace CLI {
class App;
}

namespace navjit::apps {

void add_observe(CLI::App& command, Observation& observation);

/// What the commands log of it, and its share of a report.
void log_observation(const ObservedDetector& seen);

}  // namespace navjit::apps
