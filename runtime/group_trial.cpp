#include "runtime/group_trial.hpp"

#include <algorithm>
#include <numeric>

namespace navjit {
namespace {

/// As for trials of single scenes, but of every step: volumes differ among themselves by more than
/// the sides do, which takes more of them.
constexpr double least_pairs = 16;
constexpr double least_samples = 4000, enough_samples = 120000;
/// Standard errors between the sides: who looks after each pair of stretches is deceived by chance
/// sooner or later, who looks at the end is not.
constexpr double errors_apart_early = 4, errors_apart_late = 2.5;
/// Of a step: what switching so much code costs the side that has it. A guess.
constexpr double cost_of_switching = 0.02;
/// Steps of dear volumes take many times the mean; what takes this many was interrupted.
constexpr double far = 64;

}  // namespace

void record(GroupTrial& group, double ticks) {
  if (!group.open()) return;
  if (group.samples >= 64) ticks = std::min(ticks, far * group.usual);
  group.usual = (group.usual * group.samples + ticks) / (group.samples + 1);
  ++group.samples;
  (group.shown ? group.with : group.without).add(ticks, 0);
}

Verdict decide(GroupTrial& group, double now) {
  if (group.with.count > 0 && group.without.count > 0) {
    group.lost.add(group.with, group.without);
    group.with = group.without = {};
  }
  const bool late = now - group.began > Trials::most_s;
  const bool few = group.lost.pairs < least_pairs || group.samples < least_samples;
  if (few) return late ? Verdict::stays : Verdict::open;
  const double lost = group.lost.mean() - cost_of_switching * group.usual;
  const double error = group.lost.error();
  if (lost < -errors_apart_early * error) return Verdict::stays;
  if (lost > errors_apart_early * error) return Verdict::goes;
  if (!late && group.samples < enough_samples) return Verdict::open;
  return lost > errors_apart_late * error ? Verdict::goes : Verdict::stays;
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
