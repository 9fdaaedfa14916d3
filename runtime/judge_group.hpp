// All compiled code on trial at once (group_trial.hpp). Private to runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// A stretch is over, and no scene is on trial alone: goes on with the trial of a group, or begins
/// one. First comes what lost its own trials, but hardly: it is taken in if it wins. Then all
/// compiled scenes, if they are others than at the last such trial, and after them the rarest; then
/// all that is not generic. What loses is taken out, and nothing more is compiled until the run is
/// judged again.
void judge_group(Specialisation& spec);

/// What is tried is shown everywhere while the specialiser does other things. The present pair of
/// stretches does not count.
void interrupt_group(Specialisation& spec);

/// The same, and what was known of the group is forgotten: scenes are others.
void give_up_group(Specialisation& spec);

}  // namespace navjit
