#include "runtime/gather.hpp"

#include <cmath>

namespace navjit {
namespace {

constexpr std::size_t samples_kept = 512;  ///< per volume
constexpr std::size_t fresh_kept = 64;     ///< per volume and look

}  // namespace

void gather(Specialisation& spec) {
  const detail::Counts counts = spec.shared->counts();
  spec.active = false;
  for (std::size_t v = 0; v < spec.steps.size(); ++v) {
    const std::uint64_t steps = counts.steps(static_cast<VolumeId>(v));
    spec.active |= steps != spec.steps[v];
    spec.steps[v] = steps;
  }
  const double now = spec.seconds();
  if (spec.active) spec.active_s += now - spec.looked_at;
  spec.looked_at = now;
  for (const auto& profile : counts.profiles) {
    for (Sample sample; profile->take(sample);) {
      if (sample.ticks > 0) {
        record(spec.group, static_cast<double>(sample.ticks));
        // A mother that its daughters fill has no steps of its own, and is relocated in at each of
        // theirs.
        for (const auto& [volume, used] :
             {Sample::Relocation{sample.volume, sample.used}, sample.left_into, sample.entered}) {
          if (used == nullptr) continue;
          spec.trials.record(volume, used, static_cast<double>(sample.ticks));
        }
      }
      if (sample.safety) continue;
      if (sample.mother != Sample::no_volume) spec.steps_below[sample.mother] += Profile::period;
      auto& fresh = spec.fresh[sample.volume];
      if (fresh.size() < fresh_kept) fresh.push_back(sample);
      auto& kept = spec.samples[sample.volume];
      if (kept.size() < samples_kept) {
        kept.push_back(sample);
      } else {
        // Newer states replace older ones here and there: the run may move on.
        kept[(spec.steps[sample.volume] * 2654435761U) % samples_kept] = sample;
      }
    }
  }
}

void update_execution_counts(Specialisation& spec) {
  // Volumes of equal structure are hot together. Relocation in a mother costs about as much as a
  // step.
  std::vector<double> executions(spec.steps.size(), 0);
  for (std::size_t v = 0; v < spec.steps.size(); ++v) {
    executions[spec.facts.first_equal[v]] +=
        static_cast<double>(spec.steps[v] + spec.steps_below[v]);
  }
  const double t = spec.seconds();
  const double fades =
      std::exp2((spec.counted_at - t) / spec.shared->options.specialiser.half_life_s);
  spec.counted_at = t;
  for (std::size_t v = 0; v < executions.size(); ++v) {
    spec.recent[v] = fades * spec.recent[v] + executions[v] - spec.execution_counts[v];
  }
  spec.execution_counts = std::move(executions);
}

}  // namespace navjit
