// Which navjit this is.
#pragma once

#include <string>

namespace navjit {

/// One line for people: version, the compiler that built it, LLVM's version or that there is none,
/// and the begin of the fingerprint of all that decides what generated code is.
std::string version_line();

}  // namespace navjit
