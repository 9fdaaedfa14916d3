// Compiled code is also tried as a whole. The code of each scene may win its own trial while all of
// it together fills caches and branch tables that other steps need. That shows only when all steps
// of the run are timed, with all of the code and with none of it in turn. Everything that is
// installed is tried in the same way against the generic navigator alone, and so are scenes that
// lost their own trials on weak evidence.
#pragma once

#include <vector>

#include "runtime/trials.hpp"

namespace navjit {

/// What is tried together, and against what it is tried.
enum class Group : std::uint8_t {
  code,      ///< compiled code, against navigators that are bound to data
  all,       ///< all navigators that are not generic, against the generic one
  unproved,  ///< bound to data and narrowly lost its own trial, against what is installed
};

/// Volumes that are switched together. Not thread-safe.
struct GroupTrial {
  std::vector<VolumeId> members{};  ///< if empty, nothing is tried
  Group group = Group::code;
  double began = 0;    ///< s of navigation
  bool shown = true;   ///< whether the present stretch has the side that is tried
  unsigned looks = 0;  ///< how often the profile was looked at since the trial began
  double steps_before = 0, ns_before = 0;  ///< of the whole run, when the present stretch began
  TickSum all{};                           ///< steps, and the time that they took, ns
  TickSum with{}, without{};               ///< of the present pair of stretches
  PairedDifference lost{};                 ///< what the side that is tried loses, ns a step

  bool open() const { return !members.empty(); }
};

/// Must be called at the end of a stretch. `steps` and `ns` are the steps of the run so far and the
/// processor time of the navigating threads, ns. (Timing single steps would mislead: the processor
/// predicts the branches of a timed step less well than those of others, and the more code there is
/// the worse it predicts.) `lasts` is a factor on the time, for tests.
void record(GroupTrial& group, double steps, double ns, double lasts = 1);
/// Must be called at the beginning of a stretch.
void begin_stretch(GroupTrial& group, double steps, double ns);

/// Must be called at the end of a pair of stretches. The verdict from what is known at the time
/// `now`, s of navigation. A group is taken out only if its loss is hardly by chance; an unproved
/// group stays only if it is the faster side.
Verdict decide(GroupTrial& group, double now);

/// The result of all trials of single scenes together: the share of the time that the winners save.
/// Each trial counts by the steps and relocations in its volume, `executions`.
double saved_share(const std::map<VolumeId, Trial>& trials, const std::vector<double>& executions);

struct Member {
  VolumeId volume;
  double executions;  ///< steps and relocations in it
};

/// Whether a scene may have lost its trial by chance. Where thousands of scenes have a few hundred
/// timed steps each, and are judged again and again, some of them do.
bool hardly_lost(const Trial& trial);

/// The members with the fewest executions: those left when the hottest, which have `share` of all
/// executions, are taken away.
std::vector<VolumeId> rarest(std::vector<Member> members, double share);

}  // namespace navjit
