#include "runtime/group_trial.hpp"

#include <algorithm>
#include <numeric>

namespace navjit {
namespace {

/// As for trials of single scenes, but of every step: volumes differ among themselves by more than
/// the sides do, which takes more of them.
constexpr double least_pairs = 16;
constexpr double least_samples = 4000, enough_samples = 60000;
constexpr double errors_apart = 2.5;
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
  const double lost = group.lost.mean(), error = group.lost.error();
  if (lost > errors_apart * error) return Verdict::goes;
  if (lost < -errors_apart * error) return Verdict::stays;
  return late || group.samples > enough_samples ? Verdict::stays : Verdict::open;
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
