#include "runtime/choose.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "analysis/plan.hpp"
#include "runtime/bind_to_data.hpp"
#include "runtime/gather.hpp"
#include "runtime/log_text.hpp"
#include "runtime/overrides.hpp"

namespace navjit {
namespace {

/// The share of the time of a data-bound step that constants save, on average (docs/decisions.md).
constexpr double gain_over_data = 0.35;

}  // namespace

void apply_overrides(Specialisation& spec) {
  const char* text = std::getenv(overrides_variable);
  if (text == nullptr) return;
  const Overrides overrides = parse_overrides(spec.shared->geometry.world(), text);
  for (const auto& [volume, search] : overrides.searches) {
    if (!search) {
      // Only this volume, not those equal to it: the problem may be in that part of the shared
      // navigator which is its own.
      spec.bound.insert(volume);
      spec.off.insert(volume);
      const std::lock_guard lock(spec.mutex);
      SceneReport& scene = spec.scenes[volume];
      scene.status = SceneStatus::unprofitable;
      scene.note = std::string("off by ") + overrides_variable;
    } else {
      // Equal volumes share a navigator, and so also what is forced on one of them.
      const VolumeId first = spec.facts.first_equal[volume];
      spec.facts.forced_candidates[first] = *search;
      spec.forced.insert(first);
    }
  }
  if (!overrides.complaints.empty()) {
    spec.shared->log->warn("{}: {}", overrides_variable, overrides.complaints);
  }
}

bool may_be_tried(Specialisation& spec, VolumeId volume) {
  // Equal volumes have the same status, apart from those that are off.
  const std::vector<VolumeId>& equals = spec.facts.equals[volume];
  const auto one = std::find_if(equals.begin(), equals.end(),
                                [&](VolumeId equal) { return !spec.off.contains(equal); });
  if (one == equals.end()) return false;
  const std::lock_guard lock(spec.mutex);
  const auto known = spec.scenes.find(*one);
  if (known == spec.scenes.end()) return true;
  if (known->second.status == SceneStatus::generic) return true;  // bound to data, or to nothing
  if (known->second.status != SceneStatus::unprofitable) return false;
  // Code that was slower on the states recorded then may be faster on those of another phase of the
  // run.
  const auto again = spec.try_again_at.find(volume);
  return again != spec.try_again_at.end() && spec.execution_counts[volume] >= again->second;
}

DueScenes due_scenes(Specialisation& spec) {
  DueScenes due{{}, spec.shared->options.specialiser};
  SpecialiserOptions& options = due.options;
  if (spec.hopeless || !options.constants) return due;
  if (spec.group_lost || spec.allowance_is_used_up()) return due;
  options.module_ms = most_module_ms(spec.seconds(), options) / spec.slower_than_expected();
  options.compile_weight = spec.compile_weight();
  update_execution_counts(spec);
  for (std::size_t v = 0; v < spec.execution_counts.size(); ++v) {
    const auto volume = static_cast<VolumeId>(v);
    if (spec.execution_counts[v] * 10 < static_cast<double>(options.min_steps) ||
        !may_be_tried(spec, volume))
      continue;
    Candidate& candidate = spec.candidates[volume];
    if (candidate.compile_ms == 0) {
      const ScenePlan plan = plan_scene(spec.shared->geometry, spec.facts, volume);
      if (const Worth worth = worth_compiling(spec.shared->geometry, plan); !worth) {
        note(spec, volume, SceneStatus::unprofitable, std::string(worth.why));
        continue;
      }
      const double ms = expected_compile_ms(spec.shared->geometry, plan);
      if (ms > most_scene_ms) {
        note(spec, volume, SceneStatus::unprofitable, "its solids would take too long to compile");
        continue;
      }
      candidate = {volume, 0, 0, ms, expected_gain_ns(plan)};
    }
    if (const double bound = bound_ns(spec, hottest_equal(spec, volume)); std::isfinite(bound)) {
      candidate.gain_ns = gain_over_data * bound;
    }
    candidate.executions = spec.execution_counts[v];
    candidate.recent = spec.recent[v];
    due.candidates.push_back(candidate);
    if (is_due(candidate, options)) due.paid = std::max(due.paid, times_paid(candidate, options));
  }
  return due;
}

std::vector<VolumeId> choose(const Specialisation& spec, const DueScenes& due, double least) {
  std::vector<VolumeId> module = next_module(due.candidates, due.options, least);
  if (!module.empty()) {
    spec.shared->log->debug(
        "event=chosen at_s={:.3f} scenes={} first={} candidates={}", spec.seconds(), module.size(),
        in_quotes(spec.shared->geometry.world().volumes[module[0]].name), due.candidates.size());
  }
  return module;
}

std::vector<VolumeId> worth_trying(Specialisation& spec, const std::vector<VolumeId>& batch) {
  std::vector<VolumeId> tried;
  for (const VolumeId volume : batch) {
    const ScenePlan plan = plan_scene(spec.shared->geometry, spec.facts, volume);
    if (const Worth worth = worth_compiling(spec.shared->geometry, plan)) {
      note(spec, volume, SceneStatus::compiling, "");
      tried.push_back(volume);
    } else {
      note(spec, volume, SceneStatus::unprofitable, std::string(worth.why));
    }
  }
  return tried;
}

}  // namespace navjit
