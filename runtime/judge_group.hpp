// All compiled code on trial at once (group_trial.hpp). Private to runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// A stretch is over, and no scene is on trial alone: begins a trial of all compiled scenes if they
/// are others than at the last one, goes on with it, or with that of the rarest of them, and takes
/// out what loses. Then nothing more is compiled until the run is judged again. Or it tries all
/// that is not generic, or what lost its own trials, but hardly; if that wins it is taken in.
void judge_group(Specialisation& spec);

/// What is tried is shown everywhere while the specialiser does other things. The present pair of
/// stretches does not count.
void interrupt_group(Specialisation& spec);

/// The same, and what was known of the group is forgotten: scenes are others.
void give_up_group(Specialisation& spec);

}  // namespace navjit
