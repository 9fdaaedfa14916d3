#include "runtime/judge_group.hpp"

#include <spdlog/spdlog.h>

#include "geometry/navigation/generic.hpp"

namespace navjit {
namespace {

/// When all compiled scenes have stayed, the rarest are tried again without the hottest ones, which
/// have this share of all executions in compiled scenes.
constexpr double hottest_share = 0.75;
/// The number of looks at the profile in a stretch. A stretch is long compared with the time that
/// caches take to forget the other side.
constexpr unsigned looks_in_stretch = 4;
/// Fewer scenes are not tried as a group.
constexpr std::size_t least_members = 3;
/// If the scenes' own trials say that more than this share of the time is saved, the cost to one
/// another hardly outweighs it. (In a hall of 546 volumes that took 1.06 times as long, the trials
/// said a little over 0.1.) A guess.
constexpr double no_doubt = 0.2;

/// The share of all executions that scenes which narrowly lost must have to be tried again
/// together.
constexpr double least_share = 0.05;

bool is_compiled(const Specialisation& spec, const std::shared_ptr<const void>& owner) {
  return owner != nullptr && owner != spec.arena;
}

/// The navigator that a trial left in the table, and its owner.
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

double all_executions(const Specialisation& spec) {
  double all = 0;
  for (std::size_t v = 0; v < spec.steps.size(); ++v) {
    all += spec.executions(static_cast<VolumeId>(v));
  }
  return all;
}

std::vector<VolumeId> compiled(const Specialisation& spec) {
  std::vector<VolumeId> members;
  for (const auto& [volume, trial] : spec.trials.all()) {
    if (trial.verdict == Verdict::open) continue;
    if (is_compiled(spec, owner_of_winner(trial))) members.push_back(volume);
  }
  return members;
}

/// All scenes that are not generic, if it is doubtful that they are faster.
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

/// Volumes whose navigator bound to data lost its trial on weak evidence.
std::vector<VolumeId> unproved(const Specialisation& spec) {
  std::vector<VolumeId> members;
  double executions = 0;
  for (const auto& [volume, trial] : spec.trials.all()) {
    if (!hardly_lost(trial) || trial.candidate_owner != spec.arena) continue;
    members.push_back(volume);
    executions += spec.executions(volume);
  }
  if (executions < least_share * all_executions(spec)) members.clear();
  return members;
}

/// The navigator of a member in the present stretch, on the side that is tried or on the other
/// side.
const kernels::DispatchEntry* side(const Specialisation& spec, VolumeId volume, const Trial& trial,
                                   bool tried) {
  switch (spec.group.group) {
    case Group::code:
      return tried ? winner(trial) : without_code(spec, volume);
    case Group::all:
      return tried ? winner(trial) : &generic::dispatch_entry;
    case Group::unproved:
      break;
  }
  return tried ? trial.candidate : trial.before;
}

void show(Specialisation& spec, bool tried) {
  spec.group.shown = tried;
  for (const VolumeId volume : spec.group.members) {
    const auto trial = spec.trials.all().find(volume);
    if (trial == spec.trials.all().end()) continue;  // deoptimised meanwhile
    spec.shared->table.show(volume, side(spec, volume, trial->second, tried));
  }
}

void begin(Specialisation& spec, std::vector<VolumeId> members, Group group) {
  spec.group = {};
  spec.group.members = std::move(members);
  spec.group.group = group;
  spec.group.began = spec.active_s;
  show(spec, true);
  begin_stretch(spec.group, spec.steps_made, spec.navigating_ns);
  spec.stretches = 0;
}

/// Writes a scene's binding into the reports; `note` says why it is this one.
void write_down(Specialisation& spec, VolumeId volume, Binding binding, SceneStatus status,
                const std::string& note) {
  const std::lock_guard lock(spec.mutex);
  SceneReport& scene = spec.scenes[volume];
  scene.binding = binding;
  scene.status = status;
  scene.note = note;
}

void take_out(Specialisation& spec) {
  spec.group_lost = true;
  const std::string note =
      spec.group.group == Group::all
          ? "with the other scenes that are not generic slower in the run than without"
          : "with the other compiled scenes slower in the run than without";
  for (const VolumeId volume : spec.group.members) {
    const auto trial = spec.trials.all().find(volume);
    if (trial == spec.trials.all().end()) continue;
    const kernels::DispatchEntry* record = side(spec, volume, trial->second, false);
    const bool generic = record == &generic::dispatch_entry;
    const std::shared_ptr<const void> owner = generic ? nullptr : spec.arena;
    spec.trials.take_out(volume, record, owner);
    spec.shared->table.install(volume, record, owner);
    write_down(spec, volume, generic ? Binding::generic : Binding::data, SceneStatus::unprofitable,
               note);
    have_bound(spec, volume);
  }
}

void take_in(Specialisation& spec) {
  for (const VolumeId volume : spec.group.members) {
    const auto trial = spec.trials.all().find(volume);
    // Compiled code may have come meanwhile, and be on trial itself.
    if (trial == spec.trials.all().end() || trial->second.verdict != Verdict::goes) continue;
    spec.shared->table.install(volume, trial->second.candidate, trial->second.candidate_owner);
    spec.trials.take_in(volume);
    // As for all scenes that are bound to data, constants are still to be tried.
    write_down(spec, volume, Binding::data, SceneStatus::generic, "");
  }
}

/// Begins a trial of the next group, if there is one to be tried.
void begin_next(Specialisation& spec) {
  // A group is tried again only if it has grown by more than a tenth.
  const auto worth_it = [](std::size_t members, std::size_t judged) {
    return members >= least_members && members * 10 > judged * 11;
  };
  std::vector<VolumeId> members = unproved(spec);
  if (worth_it(members.size(), spec.unproved_judged)) {
    begin(spec, std::move(members), Group::unproved);
    return;
  }
  members = compiled(spec);
  if (members.size() >= least_members && members != spec.group_judged) {
    begin(spec, std::move(members), Group::code);
    return;
  }
  members = doubtful(spec);
  if (worth_it(members.size(), spec.all_judged)) begin(spec, std::move(members), Group::all);
}

/// Acts upon the verdict on the group. `whole`: the group was all that is compiled.
void conclude(Specialisation& spec, Verdict verdict, bool whole) {
  const Group group = spec.group.group;
  const std::size_t size = spec.group.members.size();
  const bool goes = verdict == Verdict::goes;
  show(spec, group != Group::unproved || !goes);
  std::vector<VolumeId> rare;
  if (group == Group::unproved) {
    if (!goes) take_in(spec);
  } else if (goes) {
    take_out(spec);
  } else if (whole) {
    std::vector<Member> members;
    for (const VolumeId volume : spec.group.members) {
      members.push_back({volume, spec.executions(volume)});
    }
    rare = rarest(std::move(members), hottest_share);
  }
  if (group == Group::all) spec.all_judged = size;
  if (group == Group::unproved) {
    spec.unproved_judged = size;
    // A group that has just won need not be tried again as a part of all that is not generic.
    if (!goes) spec.all_judged += size;
  }
  spec.group = {};
  spec.group_judged = compiled(spec);
  if (rare.size() >= least_members) begin(spec, std::move(rare), Group::code);
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
  if (spec.group.group == Group::unproved) show(spec, false);
  spec.group = {};
}

void judge_group(Specialisation& spec) {
  GroupTrial& group = spec.group;
  if (!group.open()) begin_next(spec);
  if (!group.open() || ++group.looks % looks_in_stretch != 0) return;
  record(group, spec.steps_made, spec.navigating_ns,
         group.shown ? spec.shared->faults.specialised_lasts : 1);
  // The order is with, without, without, with, and so on, as for single scenes.
  const unsigned over = spec.stretches++ % 4;
  if (over % 2 == 0) {
    show(spec, over == 2);
    return;
  }
  const Verdict verdict = decide(group, spec.active_s);
  if (verdict == Verdict::open) return;
  const bool whole = group.group == Group::code && group.members == compiled(spec);
  spec.shared->log->debug(
      "event=judged_together at_s={:.3f} scenes={} all={} generic={} unproved={} verdict={} "
      "lost={:.1f} error={:.1f} of={:.1f} steps={:.0f}",
      spec.seconds(), group.members.size(), whole, group.group == Group::all,
      group.group == Group::unproved, verdict == Verdict::goes ? "goes" : "stays",
      group.lost.mean(), group.lost.error(), group.all.mean(), group.all.count);
  spec.trials.spend(spec.active_s - group.began);
  conclude(spec, verdict, whole);
}

}  // namespace navjit
