#include "runtime/watch.hpp"

#include <spdlog/spdlog.h>

#include <utility>

#include "geometry/navigation/generic.hpp"
#include "runtime/judge.hpp"
#include "runtime/log_text.hpp"
#include "runtime/verify.hpp"

namespace navjit {
namespace {

/// Fewer steps than this between two looks do not tell how often navigators bail out.
constexpr std::uint64_t steps_to_judge = 1000;

/// Takes out a navigator that leaves too many steps to the generic one, and those of equal volumes,
/// so that they are made again with code for these steps.
void make_again(Specialisation& spec, VolumeId volume, std::uint64_t bail_outs,
                std::uint64_t steps) {
  spec.shared->log->info("scene {} left out {} of {} steps: it is made again, with code for them",
                         spec.shared->geometry.world().volumes[volume].name, bail_outs, steps);
  const std::lock_guard lock(spec.mutex);
  for (const VolumeId equal : spec.facts.equals[spec.facts.first_equal[volume]]) {
    spec.shared->table.reset(equal);
    forget_trial(spec, equal);
    spec.seen.erase(equal);
    spec.scenes.erase(equal);
    spec.bound.erase(equal);
  }
}

/// Replaces the volume's navigator by the generic one.
void deoptimise(Specialisation& spec, VolumeId volume, SceneStatus status, const std::string& why) {
  spec.shared->table.reset(volume);
  forget_trial(spec, volume);
  spec.seen.erase(volume);
  spec.shared->log->warn("scene {} is generic again: {}",
                         spec.shared->geometry.world().volumes[volume].name, one_line(why));
  const std::lock_guard lock(spec.mutex);
  spec.scenes[volume].status = status;
  spec.scenes[volume].binding = Binding::generic;
  spec.scenes[volume].note = why;
  ++spec.totals.deoptimised;
}

}  // namespace

void watch(Specialisation& spec) {
  const double pause_s = spec.pace.thrifty * spec.shared->options.specialiser.recheck_ms * 1e-3;
  if (spec.seconds() - spec.reconsidered_at < pause_s) return;
  spec.reconsidered_at = spec.seconds();
  show_candidates(spec);
  std::vector<VolumeId> installed;
  {
    const std::lock_guard lock(spec.mutex);
    for (const auto& [volume, scene] : spec.scenes) {
      if (scene.binding != Binding::generic) installed.push_back(volume);
    }
  }
  const detail::Counts counts = spec.shared->counts();
  for (const VolumeId volume : installed) {
    if (spec.shared->table.at(volume) == &generic::dispatch_entry)
      continue;  // gone with an equal volume
    const Specialisation::Seen now{spec.steps[volume], counts.bail_outs(volume)};
    // What was counted before the first look may be an earlier navigator's.
    const auto [last, is_new] = spec.seen.try_emplace(volume, now);
    const std::uint64_t steps = now.steps - last->second.steps;
    const std::uint64_t bail_outs = now.bail_outs - last->second.bail_outs;
    const VolumeId first = spec.facts.first_equal[volume];
    if (!is_new && steps >= steps_to_judge) {
      last->second = now;
      if (bail_outs > steps / bail_out_share && spec.left_out_too_much.insert(first).second) {
        make_again(spec, volume, bail_outs, steps);
        continue;
      }
      if (bail_outs > steps / 2) {
        deoptimise(spec, volume, SceneStatus::unprofitable,
                   "it bailed out of " + std::to_string(bail_outs) + " of " +
                       std::to_string(steps) + " states");
        continue;
      }
    }
    const auto fresh = spec.fresh.find(volume);
    if (fresh == spec.fresh.end() || spec.shared->faults.skip_verification) continue;
    const std::string problem = verify(spec.shared->geometry, spec.shared->table.context(),
                                       *spec.shared->table.at(volume), volume, fresh->second);
    if (!problem.empty()) deoptimise(spec, volume, SceneStatus::failed, problem);
  }
  spec.fresh.clear();
  spec.fresh_kept = 0;
}

}  // namespace navjit
