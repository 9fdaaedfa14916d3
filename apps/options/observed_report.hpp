// What reports say of what was observed.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "navjit/observation.hpp"

namespace navjit::apps {

void print_observation(const ObservedDetector& seen);
nlohmann::ordered_json to_json(const ObservedDetector& seen);

}  // namespace navjit::apps
