// Compiled code is also tried as a whole. The code of each scene may win its own trial while all of
// it together fills caches and branch tables that other steps need. That shows only when all steps
// of the run are timed, with all of the code and with none of it in turn. Everything that is
// installed is tried in the same way against the generic navigator alone, and so are scenes that
// lost their own trials on weak evidence.
#pragma once

#include <vector>

#include "runtime/trials.hpp"

namespace navjit {

/// What is tried together, and against what.
enum class Group : std::uint8_t {
  code,      ///< what was compiled, against what is bound to data
  all,       ///< all that is not generic, against the generic navigator
  unproved,  ///< what is bound to data and narrowly lost its own trial, against what is installed
};

/// Volumes that are switched together. Not for several threads.
struct GroupTrial {
  std::vector<VolumeId> members{};  ///< none: nothing is tried
  Group group = Group::code;
  double began = 0;    ///< s of navigation
  bool shown = true;   ///< whether the present stretch has the side that is tried
  unsigned looks = 0;  ///< at the profile, since it began
  double steps_before = 0, ns_before = 0;  ///< of the whole run, when the present stretch began
  TickSum all{};                           ///< steps, and the time that they took, ns
  TickSum with{}, without{};               ///< of the present pair of stretches
  PairedDifference lost{};                 ///< by the side that is tried, ns a step

  bool open() const { return !members.empty(); }
};

/// To be called when a stretch is over. `steps` and `ns`: steps of the run so far, and the
/// processor time of the navigating threads, ns. (Timing single steps would mislead: the processor
/// predicts the branches of a timed step less well than those of others, and the more code there is
/// the worse.) `lasts`: a factor on the time, for tests.
void record(GroupTrial& group, double steps, double ns, double lasts = 1);
/// A stretch begins.
void begin_stretch(GroupTrial& group, double steps, double ns);

/// To be called when a pair of stretches is over: the verdict by what is known at time `now`, s of
/// navigation. A group goes only if its loss is hardly chance; an unproved group stays only if it
/// is the faster side.
Verdict decide(GroupTrial& group, double now);

/// What the trials of single scenes found together: the share of the time that their winners save.
/// Each trial counts by the steps and relocations in its volume, `executions`.
double saved_share(const std::map<VolumeId, Trial>& trials, const std::vector<double>& executions);

struct Member {
  VolumeId volume;
  double executions;  ///< steps and relocations in it
};

/// Whether a scene may have lost its trial by chance. Where thousands of scenes have a few hundred
/// timed steps each, and are judged again and again, some of them do.
bool hardly_lost(const Trial& trial);

/// Those with the least executions: what is left when the hottest, which have `share` of all
/// executions, are taken away.
std::vector<VolumeId> rarest(std::vector<Member> members, double share);

}  // namespace navjit
