// Speed against error, one point an engine: drawn by gnuplot, called as a program.
#pragma once

#include <string>

#include "apps/accuracy/experiment.hpp"

namespace navjit::accuracy {

/// Whether any engine has both, a speed and an error.
bool can_be_drawn(const ExperimentReport& report);

/// An SVG or a PNG, by the file's suffix. Throws Error if the suffix is another, if
/// there is no gnuplot, or if it fails.
std::string draw(const ExperimentReport& report, const std::string& title, const std::string& file);

}  // namespace navjit::accuracy
