#include "runtime/budget.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <span>

#include "analysis/error_bound.hpp"
#include "runtime/error_meter/error_meter.hpp"
#include "runtime/gather.hpp"

namespace navjit {
namespace {

/// How many of a scene's recorded states are measured: each is also answered at 113 bits.
constexpr std::size_t states_measured = 64;
/// How many states are made up for a scene of which none was recorded.
constexpr std::size_t states_made_up = 16;

std::string millimetres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", value);
  return text;
}

void measure(ErrorMeter& meter, std::span<const Sample> samples, BudgetReport& report) {
  for (const Sample& sample : samples.first(std::min(samples.size(), states_measured))) {
    const std::optional<double> error = meter.error_at(sample);
    if (!error) continue;
    ++report.states;
    report.measured_mm = std::max(report.measured_mm, *error);
  }
}

/// Both the bound and the measured error have to be within the budget. If nothing can be measured,
/// nothing is promised.
void decide(const ErrorBound& bound, double budget, BudgetReport& report) {
  report.bound_mm = bound.total();
  const bool within = report.measured_mm <= budget;
  report.met = bound.total() <= budget && within && report.states > 0;
  if (!bound.known()) {
    report.why = "no bound is known of surfaces of " + bound.unknown;
  } else if (bound.total() > budget) {
    report.why = "the bound, " + millimetres(bound.total()) + ", is above the budget";
  } else if (!within) {
    report.why = "an error of " + millimetres(report.measured_mm) + " was measured";
  } else if (!ErrorMeter::available()) {
    report.why = "the bound is " + millimetres(bound.total()) +
                 ", but this program has no reference at 113 bits to measure errors with";
  } else if (report.states == 0) {
    report.why =
        "the bound is " + millimetres(bound.total()) + ", but no state was found to measure it on";
  } else {
    report.why = "the bound is " + millimetres(bound.total());
  }
}

}  // namespace

void hold_to_budget(Specialisation& spec) {
  const double budget = *spec.shared->options.budget;
  const Geometry& geometry = spec.shared->geometry;
  gather(spec);
  const std::vector<ErrorBound> bounds = error_bounds(geometry.world());
  ErrorMeter meter(geometry, spec.shared->table.context());
  std::size_t met = 0, all = 0;
  for (std::size_t v = 0; v < spec.steps.size(); ++v) {
    if (spec.steps[v] == 0) continue;
    const auto volume = static_cast<VolumeId>(v);
    BudgetReport report;
    measure(meter, std::span(spec.samples[volume]), report);
    if (report.states == 0) {
      measure(meter, spec.sampler.states(volume, states_made_up, volume + 1), report);
    }
    decide(bounds[volume], budget, report);
    ++all;
    met += report.met ? 1 : 0;
    spec.shared->log->debug("scene {}: exact; budget {} {}: {}; {} states measured, at most {}",
                            geometry.world().volumes[volume].name, millimetres(budget),
                            report.met ? "kept" : "not promised", report.why, report.states,
                            millimetres(report.measured_mm));
    const std::lock_guard lock(spec.mutex);
    spec.scenes[volume].budget = std::move(report);
  }
  if (met < all) {
    spec.shared->log->warn(
        "budget {}: promised in {} of {} scenes; the others run exact all the same",
        millimetres(budget), met, all);
  }
}

}  // namespace navjit
