#include "runtime/reports.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "analysis/plan.hpp"
#include "geometry/navigation/generic.hpp"
#include "runtime/fingerprint.hpp"
#include "runtime/gather.hpp"
#include "runtime/verify.hpp"

namespace navjit {

const char* status_name(SceneStatus status) {
  switch (status) {
    case SceneStatus::generic:
      return "generic";
    case SceneStatus::compiling:
      return "compiling";
    case SceneStatus::specialised:
      return "specialised";
    case SceneStatus::unprofitable:
      return "unprofitable";
    case SceneStatus::failed:
      return "failed";
  }
  return "unknown";
}

const char* binding_name(Binding binding) {
  switch (binding) {
    case Binding::generic:
      return "generic";
    case Binding::data:
      return "data";
    case Binding::structure:
      return "structure";
    case Binding::constants:
      return "constants";
  }
  return "unknown";
}

const char* origin_name(CodeOrigin origin) {
  switch (origin) {
    case CodeOrigin::none:
      return "";
    case CodeOrigin::compiler:
      return "compiled";
    case CodeOrigin::cache:
      return "cache";
    case CodeOrigin::plugin:
      return "plugin";
  }
  return "unknown";
}

std::size_t specialised(const Specialisation& spec) {
  const std::lock_guard lock(spec.mutex);
  return static_cast<std::size_t>(
      std::count_if(spec.scenes.begin(), spec.scenes.end(),
                    [](const auto& s) { return s.second.binding != Binding::generic; }));
}

namespace {

/// In which volumes tracks are relocated is known only from samples. If steps say what is hot,
/// reports leave out volumes without a step, so that the list does not depend on the samples.
bool locates_more_than_it_steps(const detail::Counts& counts, std::size_t volumes) {
  std::uint64_t steps = 0;
  for (std::size_t v = 0; v < volumes; ++v) steps += counts.steps(static_cast<VolumeId>(v));
  return counts.locations() > steps;
}

}  // namespace

RuntimeReport report(const Specialisation& spec) {
  const detail::Counts counts = spec.shared->counts();
  const std::lock_guard lock(spec.mutex);
  RuntimeReport report = spec.totals;
  report.seconds = spec.seconds();
  const World& world = spec.shared->geometry.world();
  const bool locates = locates_more_than_it_steps(counts, world.volumes.size());
  for (std::size_t v = 0; v < world.volumes.size(); ++v) {
    const auto volume = static_cast<VolumeId>(v);
    SceneReport scene;
    if (const auto known = spec.scenes.find(volume); known != spec.scenes.end())
      scene = known->second;
    scene.steps = counts.steps(volume);
    scene.relocations = static_cast<std::uint64_t>(std::llround(spec.relocations[v]));
    if (scene.steps == 0 && !(locates && scene.relocations > 0)) continue;
    const auto calls = spec.compiled_solids.find(spec.shared->table.at(volume));
    if (calls != spec.compiled_solids.end()) scene.compiled_solids = calls->second;
    const double since = spec.shared->table.specialised_since(volume);
    if (since > 0) scene.specialised_at_s = std::max(since - spec.started_at, 1e-9);
    scene.volume_id = volume;
    scene.volume = world.volumes[v].name;
    report.steps += scene.steps;
    report.scenes.push_back(std::move(scene));
  }
  for (SceneReport& scene : report.scenes) {
    if (scene.steps == 0) continue;
    scene.share = static_cast<double>(scene.steps) / static_cast<double>(report.steps);
  }
  std::stable_sort(report.scenes.begin(), report.scenes.end(), [](const auto& a, const auto& b) {
    return std::tie(a.steps, a.relocations) > std::tie(b.steps, b.relocations);
  });
  return report;
}

void time_generic(Specialisation& spec, double most_seconds) {
  gather(spec);
  const bool locates = locates_more_than_it_steps(spec.shared->counts(), spec.steps.size());
  std::vector<VolumeId> hottest;
  for (std::size_t v = 0; v < spec.steps.size(); ++v) {
    if (spec.steps[v] > 0 || (locates && spec.relocations[v] > 0)) {
      hottest.push_back(static_cast<VolumeId>(v));
    }
  }
  std::stable_sort(hottest.begin(), hottest.end(), [&](VolumeId a, VolumeId b) {
    return std::tie(spec.steps[a], spec.relocations[a]) >
           std::tie(spec.steps[b], spec.relocations[b]);
  });
  double until = steady_seconds() + most_seconds;
  for (const VolumeId volume : hottest) {
    const std::string structure = plan_scene(spec.shared->geometry, spec.facts, volume).pattern;
    const std::lock_guard lock(spec.mutex);
    spec.scenes[volume].structure = structure;
    if (steady_seconds() > until) break;
  }
  until = steady_seconds() + std::min(std::max(0.1 * spec.seconds(), 0.02), most_seconds);
  for (const VolumeId volume : hottest) {
    {
      const std::lock_guard lock(spec.mutex);
      if (spec.scenes[volume].generic_ns_per_step > 0) continue;
    }
    const std::vector<Sample>& samples = spec.samples[volume];
    if (samples.empty()) continue;
    const double ns = time_per_step(spec.shared->geometry, spec.shared->table.context(),
                                    generic::dispatch_entry, samples);
    const std::lock_guard lock(spec.mutex);
    spec.scenes[volume].generic_ns_per_step = ns;
    if (steady_seconds() > until) return;
  }
}

StepProfile step_profile(const Specialisation& spec) {
  const detail::Counts counts = spec.shared->counts();
  const std::lock_guard lock(spec.mutex);
  StepProfile profile;
  profile.geometry = geometry_fingerprint(spec.shared->geometry);
  profile.runs = 1;
  const World& world = spec.shared->geometry.world();
  for (std::size_t v = 0; v < spec.relocations.size(); ++v) {
    const auto volume = static_cast<VolumeId>(v);
    const std::uint64_t steps = counts.steps(volume);
    const auto relocations = static_cast<std::uint64_t>(spec.relocations[v]);
    if (steps + relocations == 0) continue;
    profile.volumes.push_back({volume, world.volumes[v].name, steps, relocations});
  }
  return profile;
}

}  // namespace navjit
