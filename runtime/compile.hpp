// The compiler at work, on a thread of its own. Private to runtime/.
#pragma once

#include <string>

#include "runtime/specialisation.hpp"

namespace navjit {

/// Waits for the code. During a run hot scenes are bound to data and trials go on meanwhile. Fails
/// as stopped as soon as the run ends: the compiler is left to itself then, asked to stop. A fault
/// may be injected, and memory may give out.
Expected<CodeMaker::Made> compile(Specialisation& spec, const std::string& source);

}  // namespace navjit
