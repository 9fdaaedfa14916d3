// What reports say of what was observed.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "navjit/observation.hpp"

namespace navjit::apps {

/// By how much a ray may change, with the unit: "0.5%", "0.01 radiation lengths".
std::string bound_text(const Observation& observation, double bound);
void print_observation(const ObservedDetector& seen);
nlohmann::ordered_json to_json(const ObservedDetector& seen);

}  // namespace navjit::apps
