// Text from a file that is read, as the messages about this file quote it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace navjit {

/// The text, fit for a one-line message: '?' for each control character, cut if too long.
std::string printable(std::string_view text, std::size_t longest = 200);
/// The same for the name of a file, of which nothing is cut.
inline std::string printable_path(std::string_view path) { return printable(path, 4096); }

}  // namespace navjit
