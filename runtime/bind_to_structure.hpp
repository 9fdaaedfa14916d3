// Scenes of structures that the library has no instance for get code that is compiled once for each
// structure. Private to runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// Compiles the structure on which most was spent so far for what it costs, if that is worth it,
/// and installs it in all scenes that have it and are hot. True if there may be another. `all`:
/// whatever was spent, in all scenes of the tree.
bool bind_to_structure(Specialisation& spec, bool all);

}  // namespace navjit
