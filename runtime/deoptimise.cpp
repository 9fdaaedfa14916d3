// The part of the specialiser that takes navigators out again.
#include <spdlog/spdlog.h>

#include <chrono>

#include "geometry/navigation/generic.hpp"
#include "runtime/log_text.hpp"
#include "runtime/specialiser.hpp"
#include "runtime/verify.hpp"

namespace navjit {
namespace {

/// Fewer steps between two looks tell nothing about how often navigators bail out.
constexpr std::uint64_t steps_to_judge = 1000;

}  // namespace

void Specialiser::reconsider() {
  if (seconds() - reconsidered_at_ < shared_->options.specialiser.recheck_ms * 1e-3) return;
  reconsidered_at_ = seconds();
  std::vector<VolumeId> installed;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [volume, scene] : scenes_) {
      if (scene.binding != Binding::generic) installed.push_back(volume);
    }
  }
  const detail::Counts counts = shared_->counts();
  for (const VolumeId volume : installed) {
    if (shared_->table.at(volume) == &generic::dispatch_entry)
      continue;  // gone with an equal volume
    const Seen now{steps_[volume], counts.bail_outs(volume)};
    // At the first look only what is counted from then on is known to be the installed one's.
    const auto [last, is_new] = seen_.try_emplace(volume, now);
    const std::uint64_t steps = now.steps - last->second.steps;
    const std::uint64_t bail_outs = now.bail_outs - last->second.bail_outs;
    const VolumeId first = facts_.first_equal[volume];
    if (!is_new && steps >= steps_to_judge) {
      last->second = now;
      if (bail_outs > steps / bail_out_share && left_out_too_much_.insert(first).second) {
        make_again(volume, bail_outs, steps);
        continue;
      }
      if (bail_outs > steps / 2) {
        deoptimise(volume, SceneStatus::unprofitable,
                   "it bailed out of " + std::to_string(bail_outs) + " of " +
                       std::to_string(steps) + " states");
        continue;
      }
    }
    const auto fresh = fresh_.find(volume);
    if (fresh == fresh_.end() || shared_->faults.skip_verification) continue;
    const std::string problem = verify(shared_->geometry, shared_->table.context(),
                                       *shared_->table.at(volume), volume, fresh->second);
    if (!problem.empty()) deoptimise(volume, SceneStatus::failed, problem);
  }
  fresh_.clear();
}

void Specialiser::make_again(VolumeId volume, std::uint64_t bail_outs, std::uint64_t steps) {
  shared_->log->info("scene {} left out {} of {} steps: it is made again, with code for them",
                     shared_->geometry.world().volumes[volume].name, bail_outs, steps);
  const std::lock_guard lock(mutex_);
  for (const VolumeId equal : facts_.equals[facts_.first_equal[volume]]) {
    shared_->table.reset(equal);
    seen_.erase(equal);
    scenes_.erase(equal);
    bound_.erase(equal);
  }
}

void Specialiser::deoptimise(VolumeId volume, SceneStatus status, const std::string& why) {
  shared_->table.reset(volume);
  seen_.erase(volume);
  shared_->log->warn("scene {} is generic again: {}",
                     shared_->geometry.world().volumes[volume].name, one_line(why));
  const std::lock_guard lock(mutex_);
  scenes_[volume].status = status;
  scenes_[volume].binding = Binding::generic;
  scenes_[volume].note = why;
  ++totals_.deoptimised;
}

}  // namespace navjit
