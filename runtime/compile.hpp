// The compiler at work, on a thread of its own. Private to runtime/.
#pragma once

#include <string>

#include "runtime/specialisation.hpp"

namespace navjit {

/// Compiles the source and waits for the code. During a run hot scenes are bound to data and trials
/// go on meanwhile. Fails as stopped as soon as the run ends: the compiler has been asked to stop
/// then, and is left to itself. Also fails, as exhausted, for want of memory or of a thread.
Expected<CodeMaker::Made> compile(Specialisation& spec, const std::string& source);

}  // namespace navjit
