// Takes over what navigating threads counted and recorded. Private to runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// Takes over counts and samples from all profiles.
void gather(Specialisation& spec);

/// Updates the execution counts from what was gathered last.
void update_execution_counts(Specialisation& spec);

}  // namespace navjit
