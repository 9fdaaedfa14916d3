// Files that are compressed by gzip.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "navjit/detail/expected.hpp"

namespace navjit::gdml {

/// Whether the contents of a file are compressed by gzip, whatever its name.
bool is_gzipped(std::string_view contents);

/// The text of all members of a gzipped file, or what is wrong: it is longer than `most` bytes, or
/// the contents are damaged. Never holds more than `most` bytes and one block.
Expected<std::string> unpack_gzip(std::string_view contents, std::size_t most);

}  // namespace navjit::gdml
