// What was compiled is tried as one, too. Each scene's code may win its own trial while all of it
// together wears caches and branch tables that every other step needs: that is seen only where all
// steps of the run are timed, with all of the code and with none of it. So is all that is
// installed, against the generic navigator alone, and so are scenes that lost their own trials by
// little that was known of them.
#pragma once

#include <vector>

#include "runtime/trials.hpp"

namespace navjit {

/// What is tried together, and against what.
enum class Group : std::uint8_t {
  code,      ///< what was compiled, against what is bound to data
  all,       ///< all that is not generic, against the generic navigator
  unproved,  ///< what is bound to data and lost its own trials, but hardly; against what is there
};

/// Volumes that are switched together. Not for several threads.
struct GroupTrial {
  std::vector<VolumeId> members{};  ///< none: nothing is tried
  Group group = Group::code;
  double began = 0;    ///< s of navigation
  bool shown = true;   ///< what the members' trials left, in the present stretch
  unsigned looks = 0;  ///< at the profile, since it began
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
/// only where that is no chance; what is unproved stays only where it is the faster side.
Verdict decide(GroupTrial& group, double now);

/// What the trials of single scenes found together, as a share of all the time that they saw: what
/// their winners save of the steps and relocations, `executions`, by volume.
double saved_share(const std::map<VolumeId, Trial>& trials, const std::vector<double>& executions);

struct Member {
  VolumeId volume;
  double executions;  ///< steps and relocations in it
};

/// Whether a scene lost its trial by what may be chance: thousands of scenes have a few hundred
/// timed steps each, and are looked at again and again.
bool hardly_lost(const Trial& trial);

/// Those with the least executions: what is left when the hottest, which have `share` of all
/// executions, are taken away.
std::vector<VolumeId> rarest(std::vector<Member> members, double share);

}  // namespace navjit
