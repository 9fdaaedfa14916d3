// Files that are read as a whole.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "navjit/detail/expected.hpp"

namespace navjit {

/// Why a file with these contents is none, or null: in repositories that keep large files by Git
/// LFS, a clone without it has a short text in the place of each.
const char* why_not_fetched(std::string_view contents);

/// The bytes of a regular file; one of more than `most` bytes fails with the message `too_long`.
/// What is no regular file (a pipe, a device) is not opened: it might never end. A file that Git
/// LFS has not fetched fails, too.
Expected<std::string> read_regular_file(const std::filesystem::path& path, std::size_t most,
                                        const std::string& too_long);

}  // namespace navjit
