// Steps per second against time, and the share of steps specialised: as numbers, and drawn by
// gnuplot.
#pragma once

#include <string>
#include <vector>

#include "apps/warmup/experiment.hpp"

namespace navjit::warmup {

/// Medians over the repetitions of a variant, at even distances in time.
struct Curve {
  Variant variant;
  struct Moment {
    double seconds, million_steps_per_second, percent_specialised;
  };
  std::vector<Moment> moments;
};
/// Of variants that were run, as far as all of them went; empty if nothing was measured.
std::vector<Curve> curves_of(const ExperimentReport& report);

/// Both of them. Throws what common::plot throws.
std::string draw(const ExperimentReport& report, const std::string& title, const std::string& file);

}  // namespace navjit::warmup
