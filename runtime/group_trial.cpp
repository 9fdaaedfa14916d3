#include "runtime/group_trial.hpp"

#include <algorithm>
#include <numeric>

namespace navjit {
namespace {

/// The pairs of stretches that a verdict needs, since stretches differ by what the run does in
/// them.
constexpr double least_pairs = 8;
/// The number of standard errors by which the sides have to differ. Looking after each pair of
/// stretches means to be deceived by chance sooner or later, so an early verdict needs a large
/// difference. At the end of a trial one looks only once; there the likelier side wins, with a
/// small margin.
constexpr double errors_apart_early = 4, errors_apart_late = 0.5;
/// The same for the loss of a single scene: of thousands, one loses by chance.
constexpr double errors_apart_alone = 4;
/// The share of a step's time that switching so much code costs the side that has it. A guess.
constexpr double cost_of_switching = 0.02;

Verdict verdict_on(const GroupTrial& group, double now) {
  const bool late = now - group.began > Trials::most_s;
  if (group.lost.pairs < least_pairs) return late ? Verdict::stays : Verdict::open;
  const double lost = group.lost.mean() - cost_of_switching * group.all.mean();
  const double error = group.lost.error();
  if (lost < -errors_apart_early * error) return Verdict::stays;
  if (lost > errors_apart_early * error) return Verdict::goes;
  if (!late) return Verdict::open;
  return lost > errors_apart_late * error ? Verdict::goes : Verdict::stays;
}

}  // namespace

void begin_stretch(GroupTrial& group, double steps, double ns) {
  group.steps_before = steps;
  group.ns_before = ns;
}

void record(GroupTrial& group, double steps, double ns, double lasts) {
  const TickSum stretch{steps - group.steps_before, lasts * (ns - group.ns_before)};
  begin_stretch(group, steps, ns);
  for (TickSum* sum : {&group.all, group.shown ? &group.with : &group.without}) {
    sum->count += stretch.count;
    sum->sum += stretch.sum;
  }
}

Verdict decide(GroupTrial& group, double now) {
  if (group.with.count > 0 && group.without.count > 0) {
    group.lost.add(group.with, group.without);
    group.with = group.without = {};
  }
  const Verdict verdict = verdict_on(group, now);
  const bool faster = group.lost.pairs >= least_pairs && group.lost.mean() < 0;
  const bool unproved = group.group == Group::unproved && !faster;
  return verdict == Verdict::stays && unproved ? Verdict::goes : verdict;
}

bool hardly_lost(const Trial& trial) {
  if (trial.verdict != Verdict::goes) return false;
  const double lost = trial.lost.mean() - trial.allowed;
  return trial.is_rare() || lost < errors_apart_alone * trial.lost.error();
}

double saved_share(const std::map<VolumeId, Trial>& trials, const std::vector<double>& executions) {
  double saved = 0, all = 0;
  for (const auto& [volume, trial] : trials) {
    if (trial.with.count == 0 || trial.without.count == 0) continue;
    const double before = executions[volume] * trial.without.mean();
    all += before;
    if (trial.verdict == Verdict::stays) {
      saved += before - executions[volume] * trial.with.mean();
    }
  }
  return all > 0 ? saved / all : 0;
}

std::vector<VolumeId> rarest(std::vector<Member> members, double share) {
  std::stable_sort(members.begin(), members.end(),
                   [](const Member& a, const Member& b) { return a.executions > b.executions; });
  const double all =
      std::accumulate(members.begin(), members.end(), 0.0,
                      [](double sum, const Member& m) { return sum + m.executions; });
  std::vector<VolumeId> rare;
  double before = 0;
  for (const Member& m : members) {
    if (before >= share * all) rare.push_back(m.volume);
    before += m.executions;
  }
  return rare;
}

}  // namespace navjit
