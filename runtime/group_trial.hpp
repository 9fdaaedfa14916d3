// What was compiled is tried as one, too. Each scene's code may win its own trial while all of it
// together wears caches and branch tables that every other step needs: that is seen only where all
// steps of the run are timed, with all of the code and with none of it.
#pragma once

#include <vector>

#include "runtime/trials.hpp"

namespace navjit {

/// Volumes that are switched together. Not for several threads.
struct GroupTrial {
  std::vector<VolumeId> members{};  ///< none: nothing is tried
  double began = 0;                 ///< s of navigation
  bool shown = true;                ///< the members' compiled code, in the present stretch
  unsigned looks = 0;               ///< at the profile, since it began
  double usual = 0;                 ///< mean of all samples so far, ticks
  double samples = 0;
  TickSum with{}, without{};  ///< of the present pair of stretches
  PairedDifference lost{};    ///< by the code

  bool open() const { return !members.empty(); }
};

/// A step or safety of any volume took so long.
void record(GroupTrial& group, double ticks);

/// A pair of stretches is over. What is known of the group at time `now`, s of navigation: it goes
/// only where that is no chance.
Verdict decide(GroupTrial& group, double now);

struct Member {
  VolumeId volume;
  double executions;  ///< steps and relocations in it
};

/// Those with the least executions: what is left when the hottest, which have `share` of all
/// executions, are taken away.
std::vector<VolumeId> rarest(std::vector<Member> members, double share);

}  // namespace navjit
