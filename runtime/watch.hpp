// Watches installed navigators: those that bail out too often, or give a wrong answer, are taken
// out. Private to runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// Checks bail-outs, and answers on states recorded since the last look.
void watch(Specialisation& spec);

}  // namespace navjit
