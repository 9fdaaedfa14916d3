// Files that are compressed by gzip.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "navjit/detail/expected.hpp"

namespace navjit::gdml {

/// Whether the contents of a file are compressed by gzip, whatever its name.
bool is_gzipped(std::string_view contents);

/// The text of a gzipped file, all its members, or what is wrong: it is more than `most` bytes, or
/// the contents are damaged. Never holds more than `most` bytes and a block.
Expected<std::string> unpack_gzip(std::string_view contents, std::size_t most);

}  // namespace navjit::gdml
