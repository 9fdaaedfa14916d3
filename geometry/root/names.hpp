// Names from files, as texts that may be written anywhere.
#pragma once

#include <string>
#include <string_view>

namespace navjit::root {

/// The name in UTF-8: one that is not is taken for Latin-1. What cannot be printed becomes '?'.
/// Throws FormatError if it has more than 65,536 bytes.
std::string readable(std::string_view name);

}  // namespace navjit::root
