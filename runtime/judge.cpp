#include "runtime/judge.hpp"

#include <spdlog/spdlog.h>

#include <limits>

#include "geometry/navigation/generic.hpp"
#include "runtime/gather.hpp"
#include "runtime/judge_group.hpp"
#include "runtime/log_text.hpp"
#include "runtime/measured_search.hpp"

namespace navjit {
namespace {

/// How many ticks longer a timed step of compiled code takes than others. The processor predicts
/// the target of the timed call badly; for code that many scenes share the target is always the
/// same. In a calorimeter with 50 layer volumes, code that lost 12 to 20 ticks for this reason was
/// 16 ticks faster in the run. Scenes that pass because of this allowance are judged together
/// (runtime/judge_group.hpp), by the time of all steps.
constexpr double unforeseen_ticks = 30;

/// Whether this owner's navigators are bound to data or to a structure.
bool holds_no_constants(const Specialisation& spec, const std::shared_ptr<const void>& owner) {
  return owner == spec.arena || spec.structures.contains(owner);
}

/// A navigator that took no more than this share of the generic navigator's time on recorded states
/// will hardly lose in the run. A guess.
constexpr double convincing_share = 0.9;

/// Whether the navigator installed in the volume was that much faster on states of this run.
bool replayed_faster(const Specialisation& spec, VolumeId volume) {
  const auto samples = spec.samples.find(volume);
  if (samples == spec.samples.end() || samples->second.size() < few_recorded) return false;
  const std::lock_guard lock(spec.mutex);
  const auto scene = spec.scenes.find(volume);
  if (scene == spec.scenes.end()) return false;
  const double ns = scene->second.specialised_ns_per_step;
  return ns > 0 && ns <= convincing_share * scene->second.generic_ns_per_step;
}

/// Installs one side of the trial, the navigator before it if `goes` and otherwise the candidate,
/// and updates the report.
void install_side(Specialisation& spec, VolumeId volume, Trial& trial, bool goes) {
  trial.out = goes;
  const std::shared_ptr<const void>& owner = goes ? trial.before_owner : trial.candidate_owner;
  spec.shared->table.install(volume, goes ? trial.before : trial.candidate, owner);
  const std::lock_guard lock(spec.mutex);
  SceneReport& scene = spec.scenes[volume];
  scene.binding = owner == nullptr                  ? Binding::generic
                  : owner == spec.arena             ? Binding::data
                  : spec.structures.contains(owner) ? Binding::structure
                                                    : Binding::constants;
  // A trial of a navigator that is bound to data says nothing about constants, which are still to
  // be tried, unless they have failed or lost before.
  if (holds_no_constants(spec, trial.candidate_owner) && scene.binding != Binding::constants &&
      (scene.status == SceneStatus::failed || spec.try_again_at.contains(volume))) {
    return;
  }
  scene.status = scene.binding == Binding::constants               ? SceneStatus::specialised
                 : holds_no_constants(spec, trial.candidate_owner) ? SceneStatus::generic
                                                                   : SceneStatus::unprofitable;
  scene.note = goes ? "slower in the run than what was there" : "";
}

void install_winner(Specialisation& spec, VolumeId volume, Trial& trial) {
  const bool goes = trial.verdict == Verdict::goes;
  if (trial.out != goes) {
    install_side(spec, volume, trial, goes);
  } else {
    spec.shared->table.show(volume, goes ? trial.before : trial.candidate);
  }
}

/// The winner was tried against a navigator that had not been judged itself. It is now tried
/// against the one against which that was on trial.
void try_against_earlier(Specialisation& spec, VolumeId volume, const Trial& trial) {
  const bool goes = trial.verdict == Verdict::goes;
  const Trial::Earlier& earlier = trial.earlier.front();
  Trial next{goes ? trial.before : trial.candidate, earlier.entry,
             goes ? trial.before_owner : trial.candidate_owner, earlier.owner};
  next.earlier.assign(trial.earlier.begin() + 1, trial.earlier.end());
  next.allowed = next.candidate_owner == spec.arena ? 0 : unforeseen_ticks;
  spec.trials.begin(volume, std::move(next), spec.active_s);
}

/// If the trial's winner is not compiled, it becomes the navigator that the volume has without
/// compiled code.
void note_without_code(Specialisation& spec, VolumeId volume, const Trial& trial) {
  const bool goes = trial.verdict == Verdict::goes;
  const std::shared_ptr<const void>& owner = goes ? trial.before_owner : trial.candidate_owner;
  if (owner != nullptr && owner != spec.arena) return;
  spec.without_code[volume] = goes ? trial.before : trial.candidate;
  search_as_bound(spec, volume);
}

void conclude(Specialisation& spec, VolumeId volume, Trial& trial) {
  if (spec.shared->faults.pass_trials) trial.verdict = Verdict::stays;
  if (spec.shared->faults.lose_trials) trial.verdict = Verdict::goes;
  spec.shared->log->debug(
      "event=judged at_s={:.3f} scene={} verdict={} with_ticks={:.0f} without_ticks={:.0f} "
      "with_steps={:.0f} without_steps={:.0f} lost={:.1f} error={:.1f}",
      spec.seconds(), in_quotes(spec.shared->geometry.world().volumes[volume].name),
      trial.verdict == Verdict::goes ? "goes" : "stays", trial.with.mean(), trial.without.mean(),
      trial.with.count, trial.without.count, trial.lost.mean(), trial.lost.error());
  install_winner(spec, volume, trial);
  if (trial.verdict == Verdict::goes) have_bound(spec, volume);
  note_without_code(spec, volume, trial);
  if (!trial.earlier.empty() && !spec.stopping()) {
    try_against_earlier(spec, volume, trial);
    return;
  }
  // Now it is the turn of another way to bind the scene to data.
  const auto second = spec.second_choices.find(volume);
  if (second == spec.second_choices.end() || spec.stopping()) return;
  const kernels::DispatchEntry* candidate = second->second;
  spec.second_choices.erase(second);
  if (trial.candidate_owner != spec.arena) return;  // compiled code came first
  spec.shared->table.install(volume, candidate, spec.arena);
  // It was the slower one on recorded states, so it has to prove itself.
  try_out(spec, volume, candidate, spec.arena, true);
  const std::lock_guard lock(spec.mutex);
  spec.scenes[volume].binding = Binding::data;
}

}  // namespace

void try_out(Specialisation& spec, VolumeId volume, const kernels::DispatchEntry* candidate,
             const std::shared_ptr<const void>& owner, bool to_be_proved) {
  if (!spec.shared->options.specialiser.keep_only_faster ||
      spec.forced.contains(spec.facts.first_equal[volume])) {
    spec.trials.end(volume);
    return;
  }
  Trial trial{candidate, &generic::dispatch_entry, owner, nullptr};
  // The other side is the navigator that is bound to data or to a structure, if there is one and it
  // has not lost.
  const auto last = spec.trials.all().find(volume);
  if (last != spec.trials.all().end()) {
    const Trial& earlier = last->second;
    const bool lost = earlier.verdict == Verdict::goes;
    const auto& best = lost ? earlier.before_owner : earlier.candidate_owner;
    if (best != nullptr && holds_no_constants(spec, best)) {
      trial.before = lost ? earlier.before : earlier.candidate;
      trial.before_owner = best;
      if (earlier.verdict == Verdict::open && !replayed_faster(spec, volume)) {
        trial.earlier = {{earlier.before, earlier.before_owner}};
        trial.earlier.insert(trial.earlier.end(), earlier.earlier.begin(), earlier.earlier.end());
      }
    }
  }
  if (owner != spec.arena) trial.allowed = unforeseen_ticks;
  trial.to_be_proved = to_be_proved;
  spec.trials.begin(volume, std::move(trial), spec.active_s);
}

void forget_trial(Specialisation& spec, VolumeId volume) {
  spec.trials.end(volume);
  spec.second_choices.erase(volume);
  spec.without_code.erase(volume);
}

void show_candidates(Specialisation& spec) {
  spec.stretches = 0;
  interrupt_group(spec);
  if (spec.candidates_shown) return;
  spec.candidates_shown = true;
  for (const auto& [volume, trial] : spec.trials.all()) {
    if (trial.verdict == Verdict::open) spec.shared->table.show(volume, trial.candidate);
  }
}

void judge(Specialisation& spec) {
  // While nothing is navigated no stretch of a trial passes.
  if (!spec.active) return;
  if (spec.trials.nearly_all_decided()) {
    judge_group(spec);
    if (spec.group.open()) return;
  } else if (spec.group.open()) {
    give_up_group(spec);
    spec.stretches = 0;
  }
  if (!spec.trials.open()) {
    for (const auto& [volume, trial] : spec.trials.begin_again(spec.active_s)) {
      // The table has to own whatever may be shown.
      if (trial->out) install_side(spec, volume, *trial, false);
    }
    if (!spec.trials.open()) return;
    spec.group_lost = false;
    spec.group_judged.clear();
    spec.all_judged = spec.unproved_judged = 0;
  }
  // The order is with, without, without, with, and so on. Two stretches are a pair, and a steady
  // change in a run favours neither side.
  const unsigned over = spec.stretches++ % 4;
  if (over % 2 == 1) {
    for (const auto& [volume, trial] : spec.trials.decide(spec.active_s)) {
      conclude(spec, volume, *trial);
    }
    if (!spec.trials.open()) show_candidates(spec);
    return;
  }
  spec.candidates_shown = over == 2;
  for (const auto& [volume, trial] : spec.trials.all()) {
    if (trial.verdict != Verdict::open) continue;
    spec.shared->table.show(volume, spec.candidates_shown ? trial.candidate : trial.before);
  }
}

void judge_finally(Specialisation& spec) {
  gather(spec);
  give_up_group(spec);
  for (const auto& [volume, trial] : spec.trials.decide(std::numeric_limits<double>::infinity())) {
    install_winner(spec, volume, *trial);
  }
}

}  // namespace navjit
