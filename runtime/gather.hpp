// What navigating threads counted and recorded, taken over by the specialiser. Private to runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// Takes over counts and samples from all profiles.
void gather(Specialisation& spec);

/// Execution counts, from what was gathered last.
void update_execution_counts(Specialisation& spec);

}  // namespace navjit
