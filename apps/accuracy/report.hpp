// The experiment as tables and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/accuracy/experiment.hpp"

namespace navjit::accuracy {

/// Tables on standard output, in Markdown: engines, surfaces by kind, the scenes with most steps,
/// and the worst steps.
void print_tables(const World& world, const ExperimentReport& report, std::size_t most_scenes);

nlohmann::ordered_json to_json(const World& world, const std::string& detector,
                               const ExperimentReport& report);

}  // namespace navjit::accuracy
