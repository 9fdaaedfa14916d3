// The run itself judges what is installed (trials.hpp). Private to runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// The volume's new navigator is on trial against what it had before. Volumes that are forced to
/// something are not judged. `to_be_proved`: it goes, too, if the run tells nothing of it.
void try_out(Specialisation& spec, VolumeId volume, const kernels::DispatchEntry* candidate,
             const std::shared_ptr<const void>& owner, bool to_be_proved = false);

/// The volume has no candidate any more.
void forget_trial(Specialisation& spec, VolumeId volume);

/// A stretch of a trial is over: decides what can be decided, and switches what is open to its
/// other side.
void judge(Specialisation& spec);

/// Decides all, by what is known.
void judge_finally(Specialisation& spec);

/// Candidates everywhere: nothing is to be slow while the specialiser has other things to do.
void show_candidates(Specialisation& spec);

}  // namespace navjit
