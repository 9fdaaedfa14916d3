// Files that are read as a whole.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "navjit/detail/expected.hpp"

namespace navjit {

/// The bytes of a regular file; one of more than `most` bytes fails with the message `too_long`.
/// What is no regular file (a pipe, a device) is not opened: it might never end.
Expected<std::string> read_regular_file(const std::filesystem::path& path, std::size_t most,
                                        const std::string& too_long);

}  // namespace navjit
