// Which navjit this is.
#pragma once

#include <string>

namespace navjit {

/// "1.2.3".
const char* version();

/// One line for people: version, the compiler that built it, LLVM's version or that there is none,
/// and the begin of the fingerprint of all that decides what generated code is.
std::string version_line();

}  // namespace navjit
