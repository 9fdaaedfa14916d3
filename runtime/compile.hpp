// Compiles on a thread of its own. Private to runtime/.
#pragma once

#include <string>

#include "runtime/specialisation.hpp"

namespace navjit {

/// Compiles the source and waits for the code. Meanwhile, during a run, hot scenes are bound to
/// data and trials go on. Fails as stopped as soon as the run ends. In that case the compiler has
/// been asked to stop, but nobody waits for it. Fails as exhausted if memory or threads run out.
Expected<CodeMaker::Made> compile(Specialisation& spec, const std::string& source);

}  // namespace navjit
