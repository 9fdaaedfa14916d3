// The experiment's results: a table for people, JSON and CSV for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/warmup/experiment.hpp"

namespace navjit::warmup {

void print_table(const ExperimentReport& report);
nlohmann::ordered_json to_json(const ExperimentReport& report);
/// Lines `variant,repetition,seconds,steps,steps_per_second,specialised_share,processor_s`: the
/// rate is that since the line before, the processor time that of the navigating threads so far.
std::string to_csv(const ExperimentReport& report);

}  // namespace navjit::warmup
