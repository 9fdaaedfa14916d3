#include "runtime/judge_group.hpp"

#include <spdlog/spdlog.h>

#include "geometry/navigation/generic.hpp"

namespace navjit {
namespace {

/// Of the executions in compiled scenes, what the hottest of them have that are not tried apart
/// from the others.
constexpr double hottest_share = 0.75;
/// Looks at the profile in a stretch: long beside what it takes the caches to forget the other
/// side.
constexpr unsigned looks_in_stretch = 4;
/// Fewer are no crowd.
constexpr std::size_t least_members = 3;
/// Where the scenes' own trials say that so much of the time is saved, what they cost one another
/// is hardly as much: of a hall of 546 volumes that took 1.06 times as long they said over 0.1. A
/// guess.
constexpr double no_doubt = 0.2;

bool is_compiled(const Specialisation& spec, const std::shared_ptr<const void>& owner) {
  return owner != nullptr && owner != spec.arena;
}

/// What a trial left in the table, and who owns it.
const kernels::DispatchEntry* winner(const Trial& trial) {
  return trial.verdict == Verdict::goes ? trial.before : trial.candidate;
}
const std::shared_ptr<const void>& owner_of_winner(const Trial& trial) {
  return trial.verdict == Verdict::goes ? trial.before_owner : trial.candidate_owner;
}

const kernels::DispatchEntry* without_code(const Specialisation& spec, VolumeId volume) {
  const auto bound = spec.without_code.find(volume);
  return bound == spec.without_code.end() ? &generic::dispatch_entry : bound->second;
}

std::vector<VolumeId> compiled(const Specialisation& spec) {
  std::vector<VolumeId> members;
  for (const auto& [volume, trial] : spec.trials.all()) {
    if (trial.verdict == Verdict::open) continue;
    if (is_compiled(spec, owner_of_winner(trial))) members.push_back(volume);
  }
  return members;
}

/// All that is not generic, if there is a doubt that it is faster.
std::vector<VolumeId> doubtful(const Specialisation& spec) {
  std::vector<double> executions(spec.steps.size());
  for (std::size_t v = 0; v < executions.size(); ++v) {
    executions[v] = spec.executions(static_cast<VolumeId>(v));
  }
  if (saved_share(spec.trials.all(), executions) > no_doubt) return {};
  std::vector<VolumeId> members;
  for (const auto& [volume, trial] : spec.trials.all()) {
    if (trial.verdict == Verdict::open) continue;
    if (winner(trial) != &generic::dispatch_entry) members.push_back(volume);
  }
  return members;
}

/// What members have while the others' turn is.
const kernels::DispatchEntry* other_side(const Specialisation& spec, VolumeId volume) {
  return spec.group.against_generic ? &generic::dispatch_entry : without_code(spec, volume);
}

void show(Specialisation& spec, bool code) {
  spec.group.shown = code;
  for (const VolumeId volume : spec.group.members) {
    const auto trial = spec.trials.all().find(volume);
    if (trial == spec.trials.all().end()) continue;  // deoptimised meanwhile
    spec.shared->table.show(volume, code ? winner(trial->second) : other_side(spec, volume));
  }
}

void begin(Specialisation& spec, std::vector<VolumeId> members, bool against_generic) {
  spec.group = {};
  spec.group.members = std::move(members);
  spec.group.against_generic = against_generic;
  spec.group.began = spec.active_s;
  begin_stretch(spec.group, spec.steps_made, spec.navigating_ns);
  spec.stretches = 0;
}

void take_out(Specialisation& spec) {
  spec.group_lost = true;
  for (const VolumeId volume : spec.group.members) {
    const kernels::DispatchEntry* record = other_side(spec, volume);
    const bool generic = record == &generic::dispatch_entry;
    const std::shared_ptr<const void> owner = generic ? nullptr : spec.arena;
    if (!spec.trials.take_out(volume, record, owner)) continue;
    spec.shared->table.install(volume, record, owner);
    const std::lock_guard lock(spec.mutex);
    SceneReport& scene = spec.scenes[volume];
    scene.binding = generic ? Binding::generic : Binding::data;
    scene.status = SceneStatus::unprofitable;
    scene.note = spec.group.against_generic
                     ? "with the other scenes that are not generic slower in the run than without"
                     : "with the other compiled scenes slower in the run than without";
  }
}

}  // namespace

void interrupt_group(Specialisation& spec) {
  if (!spec.group.open()) return;
  show(spec, true);
  spec.group.with = spec.group.without = {};
  spec.group.looks = 0;
  begin_stretch(spec.group, spec.steps_made, spec.navigating_ns);
}

void give_up_group(Specialisation& spec) {
  interrupt_group(spec);
  spec.group = {};
}

void judge_group(Specialisation& spec) {
  GroupTrial& group = spec.group;
  if (!group.open()) {
    std::vector<VolumeId> members = compiled(spec);
    if (members.size() >= least_members && members != spec.group_judged) {
      begin(spec, std::move(members), false);
    } else if (members = doubtful(spec);
               // A few more make no difference.
               members.size() >= least_members && members.size() * 10 > spec.all_judged * 11) {
      begin(spec, std::move(members), true);
    } else {
      return;
    }
  }
  if (++group.looks % looks_in_stretch != 0) return;
  record(group, spec.steps_made, spec.navigating_ns,
         group.shown ? spec.shared->faults.specialised_lasts : 1);
  const bool whole = !group.against_generic && group.members == compiled(spec);
  // With, without, without, with, ..., as for single scenes.
  const unsigned over = spec.stretches++ % 4;
  if (over % 2 == 1) {
    if (const Verdict verdict = decide(group, spec.active_s); verdict != Verdict::open) {
      spec.shared->log->debug(
          "event=judged_together at_s={:.3f} scenes={} all={} generic={} verdict={} lost={:.1f} "
          "error={:.1f} of={:.1f} steps={:.0f}",
          spec.seconds(), group.members.size(), whole, group.against_generic,
          verdict == Verdict::goes ? "goes" : "stays", group.lost.mean(), group.lost.error(),
          group.all.mean(), group.all.count);
      spec.trials.spend(spec.active_s - group.began);
      show(spec, true);
      std::vector<VolumeId> rare;
      if (verdict == Verdict::goes) {
        take_out(spec);
      } else if (whole) {
        std::vector<Member> members;
        for (const VolumeId volume : group.members) {
          members.push_back({volume, spec.executions(volume)});
        }
        rare = rarest(std::move(members), hottest_share);
      }
      if (group.against_generic) spec.all_judged = group.members.size();
      group = {};
      spec.group_judged = compiled(spec);
      if (rare.size() >= least_members) begin(spec, std::move(rare), false);
      return;
    }
    return;
  }
  show(spec, over == 2);
}

}  // namespace navjit
