// What was compiled is tried as one, too. Each scene's code may win its own trial while all of it
// together wears caches and branch tables that every other step needs: that is seen only where all
// steps of the run are timed, with all of the code and with none of it. So is all that is
// installed, against the generic navigator alone.
#pragma once

#include <vector>

#include "runtime/trials.hpp"

namespace navjit {

/// Volumes that are switched together. Not for several threads.
struct GroupTrial {
  std::vector<VolumeId> members{};  ///< none: nothing is tried
  bool against_generic = false;     ///< else against what is bound to data
  double began = 0;                 ///< s of navigation
  bool shown = true;                ///< what the members' trials left, in the present stretch
  unsigned looks = 0;               ///< at the profile, since it began
  double steps_before = 0, ns_before = 0;  ///< of the run, when the present stretch began
  TickSum all{};                           ///< steps, and the time that they took, ns
  TickSum with{}, without{};               ///< of the present pair of stretches
  PairedDifference lost{};                 ///< by the code, ns a step

  bool open() const { return !members.empty(); }
};

/// A stretch is over: of the run so many steps were made so far, in so many ns of the navigating
/// threads' processor time. (Single steps that are timed would not do: a processor foresees less of
/// them than of the others, and the more so the more code there is.)
/// `lasts`: times as long, for tests.
void record(GroupTrial& group, double steps, double ns, double lasts = 1);
/// A stretch begins.
void begin_stretch(GroupTrial& group, double steps, double ns);

/// A pair of stretches is over. What is known of the group at time `now`, s of navigation: it goes
/// only where that is no chance.
Verdict decide(GroupTrial& group, double now);

/// What the trials of single scenes found together, as a share of all the time that they saw: what
/// their winners save of the steps and relocations, `executions`, by volume.
double saved_share(const std::map<VolumeId, Trial>& trials, const std::vector<double>& executions);

struct Member {
  VolumeId volume;
  double executions;  ///< steps and relocations in it
};

/// Those with the least executions: what is left when the hottest, which have `share` of all
/// executions, are taken away.
std::vector<VolumeId> rarest(std::vector<Member> members, double share);

}  // namespace navjit
