// Makes names from files into texts that can be written anywhere.
#pragma once

#include <string>
#include <string_view>

namespace navjit::root {

/// The name in UTF-8. A name that is not UTF-8 is taken as Latin-1. What cannot be printed becomes
/// '?'. Throws FormatError if the name has more than 65,536 bytes.
std::string readable(std::string_view name);

}  // namespace navjit::root
