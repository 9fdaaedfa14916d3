// Lets the run itself judge installed navigators (trials.hpp). Private to runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// Begins a trial of the volume's new navigator against what the volume had before. Volumes that
/// are forced to a variant are not tried. `to_be_proved`: the new navigator also goes if the run
/// does not tell which is faster.
void try_out(Specialisation& spec, VolumeId volume, const kernels::DispatchEntry* candidate,
             const std::shared_ptr<const void>& owner, bool to_be_proved = false);

/// Forgets the volume's trial, and all other navigators that would be tried or shown there.
void forget_trial(Specialisation& spec, VolumeId volume);

/// Must be called at the end of a stretch of trials. Decides what can be decided, and switches the
/// open trials to their other sides.
void judge(Specialisation& spec);

/// Decides all open trials by what is known, at the end of a run.
void judge_finally(Specialisation& spec);

/// Shows the candidates of all open trials, so that nothing is slow while the specialiser does
/// something else.
void show_candidates(Specialisation& spec);

}  // namespace navjit
