#include "runtime/bind_to_data.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <limits>

#include "analysis/plan.hpp"
#include "codegen/data/bind.hpp"
#include "geometry/navigation/generic.hpp"
#include "runtime/log_text.hpp"
#include "runtime/verify.hpp"

namespace navjit {
namespace {

/// Fewer steps in a scene tell nothing of which states are met there.
constexpr std::uint64_t least_steps = 500;
/// At a time, so that other work of the thread is not put off for long.
constexpr double most_ms = 20;
/// Per volume, for verification, beside those that were recorded: the code is that of the library,
/// what may be wrong is the data.
constexpr std::size_t states_made_up = 64;
/// Of all steps, for a scene to be bound: with the many that share the rest of a run little could
/// be won. A guess.
constexpr double least_share = 0.002;
/// What is nearer than that is often the noise of such timings. A guess.
constexpr double least_gain = 0.85;

/// Where the plan's way to find daughters is not sure to be the best, the hierarchy of boxes is
/// another.
bool tree_may_be_faster(const Scene& scene, const ScenePlan& plan) {
  return scene.boxes && plan.candidates != Candidates::slabs;
}

}  // namespace

void bind_to_data(Specialisation& spec, VolumeId volume) {
  if (!spec.bound.insert(volume).second) return;
  const Geometry& geometry = spec.shared->geometry;
  const kernels::Context& context = spec.shared->table.context();
  const bool forced = spec.facts.forced_candidates.contains(spec.facts.first_equal[volume]);
  const bool only_if_faster = spec.shared->options.specialiser.keep_only_faster && !forced;
  std::vector<Sample> samples = spec.samples[volume];
  if (samples.size() < 16) samples.clear();
  const bool recorded = !samples.empty();
  const std::vector<Sample> made_up = spec.sampler.states(volume, states_made_up, volume + 1);
  if (!recorded) samples = made_up;

  ScenePlan plan = plan_scene(geometry, spec.facts, volume);
  double bound_ns = 0;
  codegen::Arena scratch;
  bound_ns =
      time_per_step(geometry, context, *codegen::bind_to_data(geometry, plan, scratch), samples);
  if (!forced && tree_may_be_faster(geometry.scene(volume), plan)) {
    ScenePlan by_tree = plan;
    by_tree.candidates = Candidates::tree;
    const double ns = time_per_step(geometry, context,
                                    *codegen::bind_to_data(geometry, by_tree, scratch), samples);
    if (ns < bound_ns) {
      bound_ns = ns;
      plan = std::move(by_tree);
    }
  }
  const double generic_ns = time_per_step(geometry, context, generic::dispatch_entry, samples);
  const kernels::DispatchEntry* bound = codegen::bind_to_data(geometry, plan, *spec.arena);
  if (recorded) samples.insert(samples.end(), made_up.begin(), made_up.end());
  std::string problem = verify(geometry, context, *bound, volume, samples);
  if (spec.shared->faults.fail_verification) problem = "injected failure";
  if (!problem.empty()) {
    note_failure(spec, volume, problem);
    return;
  }
  const bool pays = !only_if_faster || bound_ns <= least_gain * generic_ns;
  spec.shared->log->debug(
      "event=bound at_s={:.3f} scene={} structure={} generic_ns={:.1f} bound_ns={:.1f} verdict={}",
      spec.seconds(), quoted(geometry.world().volumes[volume].name),
      quoted(codegen::structure_of(geometry, plan)), generic_ns, bound_ns,
      pays ? "installed" : "slower");
  if (pays) spec.shared->table.install(volume, bound, spec.arena);
  const std::lock_guard lock(spec.mutex);
  SceneReport& scene = spec.scenes[volume];
  scene.generic_ns_per_step = generic_ns;
  if (!pays) return;
  scene.binding = Binding::data;
  scene.specialised_ns_per_step = bound_ns;
  scene.swapped_at_s = spec.seconds();
}

bool bind_hot_to_data(Specialisation& spec) {
  std::vector<VolumeId> hot;
  std::uint64_t all = 0;
  for (const std::uint64_t steps : spec.steps) all += steps;
  const auto least =
      std::max(least_steps, static_cast<std::uint64_t>(least_share * static_cast<double>(all)));
  for (std::size_t v = 0; v < spec.steps.size(); ++v) {
    const auto volume = static_cast<VolumeId>(v);
    if (spec.steps[v] + spec.steps_below[v] >= least && !spec.bound.contains(volume)) {
      hot.push_back(volume);
    }
  }
  std::stable_sort(hot.begin(), hot.end(), [&](VolumeId a, VolumeId b) {
    return spec.steps[a] + spec.steps_below[a] > spec.steps[b] + spec.steps_below[b];
  });
  const double until = steady_seconds() + most_ms * 1e-3;
  for (const VolumeId volume : hot) {
    if (spec.stopping() || steady_seconds() > until) return true;
    bind_to_data(spec, volume);
  }
  return false;
}

double bound_ns(const Specialisation& spec, VolumeId volume) {
  const std::lock_guard lock(spec.mutex);
  const auto known = spec.scenes.find(volume);
  return known != spec.scenes.end() && known->second.binding == Binding::data
             ? known->second.specialised_ns_per_step
             : std::numeric_limits<double>::infinity();
}

}  // namespace navjit
