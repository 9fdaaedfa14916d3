// What the specialiser tells of a run. Private to runtime/.
#pragma once

#include "navjit/step_profile.hpp"
#include "runtime/specialisation.hpp"

namespace navjit {

RuntimeReport report(const Specialisation& spec);

/// How many scenes have navigators of their own.
std::size_t specialised(const Specialisation& spec);

/// Times the generic navigator in scenes that have samples and no timing yet, and notes in words
/// how scenes are searched, the hottest first, for a limited time.
void time_generic(Specialisation& spec, double most_seconds);

/// What was counted so far, and what was gathered of relocations, for a file. Thread-safe.
StepProfile step_profile(const Specialisation& spec);

}  // namespace navjit
