// What is compiled next: a solid, a structure, or scenes. Private to runtime/; docs/decisions.md
// has the reasons.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// Compiles what has paid most times for it, and installs it. False if nothing is due, or the run
/// has ended.
bool compile_next(Specialisation& spec);

}  // namespace navjit
