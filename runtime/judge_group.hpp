// Trials of all compiled code at once (group_trial.hpp). Private to runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// Must be called at the end of a look, when nearly no scene is on trial alone. Continues the trial
/// of a group, or begins one. Scenes that narrowly lost their own trials come first, and are
/// installed if they win. Then all compiled scenes are tried, if they differ from those of the last
/// such trial, and after them the rarest of these. Then everything that is not generic is tried.
/// The navigators of a group that loses are taken out, and nothing more is compiled until trials
/// begin again.
void judge_group(Specialisation& spec);

/// Shows everywhere the side that is tried, while the specialiser does something else. The present
/// pair of stretches does not count.
void interrupt_group(Specialisation& spec);

/// The same, and ends the group's trial without a verdict, because the scenes on trial have
/// changed.
void give_up_group(Specialisation& spec);

}  // namespace navjit
