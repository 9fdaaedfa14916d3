// The part of the specialiser that holds scenes to the error that a user allows.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>

#include "analysis/error_bound.hpp"
#include "geometry/navigation/generic.hpp"
#include "geometry/reference/wide_geometry.hpp"
#include "runtime/specialiser.hpp"

namespace navjit {
namespace {

/// Of a scene's recorded states: each is answered at 113 bits, too.
constexpr std::size_t states_measured = 64;

std::string millimetres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", value);
  return text;
}

/// How far off a surface the scene's present navigator ends the step from this state, mm. Nothing
/// where the step ends at its limit.
std::optional<double> error_at(const Geometry& geometry, const kernels::Context& context,
                               const reference::WideGeometry& reference, const Sample& s,
                               NavigationStack& stack) {
  const reference::Chain chain = reference::chain_of(geometry.world(), s.touchable);
  const reference::WideAnswer right =
      reference.step(chain, reference::widen(s.point), reference::widen_direction(s.direction));
  if (!(right.length < s.limit)) return std::nullopt;
  generic::restore(geometry, stack, s.touchable);
  const Vec3 &p = s.point, &v = s.direction;
  kernels::set_ray(stack, v.x, v.y, v.z);
  const kernels::DispatchEntry& entry = *kernels::dispatch_entry_of(&context, s.volume);
  double length = entry.step(&stack, &context, entry.data, p.x, p.y, p.z, s.limit);
  if (length < 0) length = generic::step(geometry, stack, p, v, s.limit);
  stack.depth = -1;
  return reference.across(chain, p, v, length, right.length);
}

/// Both the bound and what was measured have to be within the budget.
void decide(const ErrorBound& bound, double budget, BudgetReport& report) {
  report.bound_mm = bound.total();
  const bool measured = report.measured_mm <= budget;
  report.met = bound.total() <= budget && measured;
  if (!bound.known()) {
    report.why = "no bound is known of surfaces of " + bound.unknown;
  } else if (bound.total() > budget) {
    report.why = "the bound, " + millimetres(bound.total()) + ", is above the budget";
  } else if (!measured) {
    report.why = "an error of " + millimetres(report.measured_mm) + " was measured";
  } else {
    report.why = "the bound is " + millimetres(bound.total());
  }
}

}  // namespace

void Specialiser::hold_to_budget() {
  const double budget = *shared_->options.budget;
  const Geometry& geometry = shared_->geometry;
  gather();
  const std::vector<ErrorBound> bounds = error_bounds(geometry.world());
  const reference::WideGeometry reference(geometry.share_world());
  const auto stack = std::make_unique<NavigationStack>();
  stack->depth = -1;
  std::size_t met = 0, all = 0;
  for (std::size_t v = 0; v < steps_.size(); ++v) {
    if (steps_[v] == 0) continue;
    const auto volume = static_cast<VolumeId>(v);
    BudgetReport report;
    const std::vector<Sample>& samples = samples_[volume];
    for (std::size_t i = 0; i < std::min(samples.size(), states_measured); ++i) {
      const auto error =
          error_at(geometry, shared_->table.context(), reference, samples[i], *stack);
      if (!error) continue;
      ++report.states;
      report.measured_mm = std::max(report.measured_mm, *error);
    }
    decide(bounds[volume], budget, report);
    ++all;
    met += report.met ? 1 : 0;
    shared_->log->debug("scene {}: exact; budget {} {}: {}; {} states measured, at most {}",
                        geometry.world().volumes[volume].name, millimetres(budget),
                        report.met ? "kept" : "not promised", report.why, report.states,
                        millimetres(report.measured_mm));
    const std::lock_guard lock(mutex_);
    scenes_[volume].budget = std::move(report);
  }
  if (met < all) {
    shared_->log->warn("budget {}: promised in {} of {} scenes; the others run exact all the same",
                       millimetres(budget), met, all);
  }
}

}  // namespace navjit
