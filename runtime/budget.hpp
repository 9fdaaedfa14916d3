// Scenes held to the error that a user allows. Private to runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// Holds scenes that made steps to options.budget, which is given.
void hold_to_budget(Specialisation& spec);

}  // namespace navjit
