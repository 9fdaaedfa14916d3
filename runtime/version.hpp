// The version of navjit.
#pragma once

#include <string>

namespace navjit {

/// One line for people: the version, the compiler that built it, LLVM's version or that there is
/// none, and the beginning of the fingerprint of all that determines generated code.
std::string version_line();

}  // namespace navjit
