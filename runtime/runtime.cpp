#include "navjit/runtime.hpp"

#include <spdlog/spdlog.h>

#include "analysis/foreign.hpp"
#include "jit/activity.hpp"
#include "navjit/errors.hpp"
#include "runtime/budget.hpp"
#include "runtime/install.hpp"
#include "runtime/reports.hpp"
#include "runtime/shared.hpp"
#include "runtime/specialiser.hpp"

namespace navjit {

namespace {

/// Only the reference at 113 bits tells how large an error is, and it does not know solids of a
/// program's own.
void refuse_budget_of_foreign(const detail::Shared& shared) {
  if (!shared.options.budget) return;
  const World& world = shared.geometry.world();
  for (VolumeId v = 0; v < world.volumes.size(); ++v) {
    if (world.volumes[v].touchables == 0 || !is_foreign(world.volumes[v].solid.any())) continue;
    throw UsageError("RuntimeOptions::budget: volume '" + world.volumes[v].name +
                     "' has a foreign solid, whose errors cannot be told; leave the budget out");
  }
}

}  // namespace

Runtime::Runtime(const Detector& detector, RuntimeOptions options)
    : Runtime(detector, std::make_shared<detail::Shared>(detector.model(), std::move(options))) {}

Runtime::Runtime(Detector detector, std::shared_ptr<detail::Shared> shared)
    : detector_(std::move(detector)),
      shared_(std::move(shared)),
      specialiser_(std::make_shared<Specialiser>(shared_)) {
  refuse_budget_of_foreign(*shared_);
  if (!shared_->options.plugin.empty())
    install_plugin(specialiser_->specialisation(), shared_->options.plugin);
  if (shared_->options.jit == JitMode::wait) {
    specialiser_->specialise_all();
  } else if (shared_->options.jit != JitMode::off) {
    specialiser_->start();
  }
}

Runtime::~Runtime() { specialiser_->stop(); }

Navigator Runtime::navigator() {
  jit::outlast_by_this_thread();
  return Navigator(shared_);
}

Basket Runtime::basket(std::size_t places) { return {navigator(), places}; }

RuntimeReport Runtime::report() const { return navjit::report(specialiser_->specialisation()); }

std::size_t Runtime::specialised() const {
  return navjit::specialised(specialiser_->specialisation());
}

RuntimeReport Runtime::final_report(double most_seconds) {
  const bool alone = specialiser_->stop();
  if (alone && most_seconds > 0) {
    time_generic(specialiser_->specialisation(), most_seconds);
    if (shared_->options.budget) hold_to_budget(specialiser_->specialisation());
  }
  return navjit::report(specialiser_->specialisation());
}

StepProfile Runtime::step_profile() { return specialiser_->step_profile(); }

void Runtime::wait_until_idle() { specialiser_->wait_until_idle(); }

}  // namespace navjit
