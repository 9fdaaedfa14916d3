#include "runtime/gather.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "geometry/navigation/generic.hpp"
#include "runtime/processor_time.hpp"

namespace navjit {
namespace {

constexpr std::size_t samples_kept = 512;  ///< per volume
constexpr std::size_t fresh_kept = 64;     ///< per volume, until they are looked at

/// The number of samples of all volumes together, some 60 MB. When there are so many, a volume
/// keeps only few_recorded, the fewest that are useful.
constexpr std::size_t all_samples_kept = std::size_t{1} << 18;
constexpr std::size_t all_fresh_kept = std::size_t{1} << 14;  ///< some 4 MB

/// Keeps a state of a volume.
void keep(Specialisation& spec, const Sample& sample) {
  auto& kept = spec.samples[sample.volume];
  const std::size_t most = spec.samples_kept < all_samples_kept ? samples_kept : few_recorded;
  if (kept.size() < most) {
    kept.push_back(sample);
    ++spec.samples_kept;
  } else {
    // Newer states replace older ones here and there: the run may move on.
    kept[(spec.steps[sample.volume] * 2654435761U) % kept.size()] = sample;
  }
  if (spec.fresh_kept == all_fresh_kept) return;
  auto& fresh = spec.fresh[sample.volume];
  if (fresh.size() == fresh_kept) return;
  fresh.push_back(sample);
  ++spec.fresh_kept;
}

double ticks_of(const Specialisation& spec, const Sample& sample,
                const kernels::DispatchEntry* used) {
  const bool generic = used == &generic::dispatch_entry;
  return static_cast<double>(sample.ticks) * (generic ? 1 : spec.shared->faults.specialised_lasts);
}

/// Relocations that were sampled, by volume.
struct Relocations {
  std::map<VolumeId, double> of{};
  std::uint64_t samples = 0;  ///< how many sampled questions they come from
};

/// Notes where a sampled question relocated the track. A mother that its daughters fill has no
/// steps of its own. All work in it is relocation, at the end of steps in its daughters or deeper
/// down.
void note_relocations(Specialisation& spec, const Sample& sample, Relocations& relocations) {
  ++relocations.samples;
  const std::span all(sample.relocations, sample.relocation_count);
  for (std::size_t i = 0; i < all.size(); ++i) {
    ++relocations.of[all[i].volume];
    // A track that leaves one touchable of a volume and enters another is relocated twice in that
    // volume; in trials it still counts as one step.
    const auto same = [&](const Sample::Relocation& r) { return r.volume == all[i].volume; };
    const bool met = std::any_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i), same);
    if (sample.ticks == 0 || met) continue;
    spec.trials.record(all[i].volume, all[i].used, ticks_of(spec, sample, all[i].used));
  }
}

}  // namespace

void gather(Specialisation& spec) {
  const detail::Counts counts = spec.shared->counts();
  std::uint64_t made = 0;  // since the last look
  for (std::size_t v = 0; v < spec.steps.size(); ++v) {
    const std::uint64_t steps = counts.steps(static_cast<VolumeId>(v));
    made += steps - spec.steps[v];
    spec.steps[v] = steps;
  }
  const std::uint64_t all_locations = counts.locations();
  const std::uint64_t located = all_locations - spec.locations;
  spec.locations = all_locations;
  // In a program that locates points more often than it makes steps, timed locations count in
  // trials. In other programs each ray is located about once, at its beginning, and these times
  // would only add to the spread of the trials' times.
  const bool locates = located > made;
  spec.steps_made += static_cast<double>(locates ? made + located : made);
  spec.navigating_ns = 1e9 * (process_seconds() - spec.own_seconds());
  spec.active = made + located > 0;
  const double now = spec.seconds();
  if (spec.active) spec.active_s += now - spec.looked_at;
  spec.looked_at = now;
  Relocations by_steps, by_locations;
  for (const auto& profile : counts.profiles) {
    for (Sample sample; profile->take(sample);) {
      if (sample.ticks > 0 && sample.used != nullptr) {
        spec.trials.record(sample.volume, sample.used, ticks_of(spec, sample, sample.used));
      }
      switch (sample.question) {
        case Question::step:
          note_relocations(spec, sample, by_steps);
          keep(spec, sample);
          break;
        case Question::location:
          if (locates) note_relocations(spec, sample, by_locations);
          break;
        case Question::safety:
          break;
      }
    }
  }
  const std::lock_guard lock(spec.mutex);  // a profile may be asked for meanwhile
  // While a queue was full fewer questions were recorded, and each sample stands for more of them.
  const auto add = [&](const Relocations& relocations, std::uint64_t asked) {
    const double each = static_cast<double>(asked) / static_cast<double>(relocations.samples);
    for (const auto& [volume, count] : relocations.of) spec.relocations[volume] += count * each;
  };
  add(by_steps, made);
  add(by_locations, located);
}

void update_execution_counts(Specialisation& spec) {
  // Equal volumes share code, so their executions count together.
  std::vector<double> executions(spec.steps.size(), 0);
  for (std::size_t v = 0; v < spec.steps.size(); ++v) {
    executions[spec.facts.first_equal[v]] += spec.executions(static_cast<VolumeId>(v));
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
