// All compiled code on trial at once (group_trial.hpp). Private to runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// To be called at the end of a look, when nearly no scene is on trial alone: continues the trial
/// of a group, or begins one. Scenes that narrowly lost their own trials come first, and are
/// installed if they win. Then all compiled scenes are tried, if they are others than at the last
/// such trial, and after them the rarest of these; then all that is not generic. The navigators of
/// a group that loses are taken out, and nothing more is compiled until trials begin again.
void judge_group(Specialisation& spec);

/// Shows the side that is tried everywhere while the specialiser does other things. The present
/// pair of stretches does not count.
void interrupt_group(Specialisation& spec);

/// The same, and ends the group's trial without a verdict, because the scenes on trial have
/// changed.
void give_up_group(Specialisation& spec);

}  // namespace navjit
