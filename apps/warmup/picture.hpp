// Steps per second against time, and the share of steps specialised: drawn by gnuplot.
#pragma once

#include <string>

#include "apps/warmup/experiment.hpp"

namespace navjit::warmup {

/// Medians over repetitions. Throws what common::plot throws.
std::string draw(const ExperimentReport& report, const std::string& title, const std::string& file);

}  // namespace navjit::warmup
