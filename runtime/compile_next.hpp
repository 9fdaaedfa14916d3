// What is compiled next: a solid, a structure, or scenes. Private to runtime/; docs/decisions.md
// gives the reasons.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// Compiles the kind that has paid for itself the most times, and installs it. Returns false if
/// nothing is due, or if the run has ended.
bool compile_next(Specialisation& spec);

}  // namespace navjit
