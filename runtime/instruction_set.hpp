// Which processor the compiler is told to compile for. Private to runtime/.
#pragma once

#include <spdlog/fwd.h>

#include "navjit/options.hpp"

namespace navjit {

/// The processor's name as the compiler knows it; empty: the processor of this machine. That is
/// also the answer for instructions that this machine lacks, and the log then has a warning.
const char* processor_for(InstructionSet set, spdlog::logger& log);

}  // namespace navjit
