// What the specialiser reports about a run. Private to runtime/.
#pragma once

#include "navjit/step_profile.hpp"
#include "runtime/specialisation.hpp"

namespace navjit {

RuntimeReport report(const Specialisation& spec);

/// How many scenes have navigators of their own.
std::size_t specialised(const Specialisation& spec);

/// Times the generic navigator in scenes that have samples but no timing yet, and notes in words
/// how scenes are searched. It begins with the hottest scene and takes a limited time.
void time_generic(Specialisation& spec, double most_seconds);

/// The steps that were counted and the relocations that were gathered so far, for a file.
/// Thread-safe.
StepProfile step_profile(const Specialisation& spec);

}  // namespace navjit
