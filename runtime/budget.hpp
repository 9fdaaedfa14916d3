// Keeps scenes within the error that a user allows. Private to runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// Keeps scenes that made steps within options.budget, which must be given.
void hold_to_budget(Specialisation& spec);

}  // namespace navjit
