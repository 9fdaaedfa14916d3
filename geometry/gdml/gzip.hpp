// Files that are compressed by gzip.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace navjit::gdml {

/// Whether the contents of a file are compressed by gzip, whatever its name.
bool is_gzipped(std::string_view contents);

/// Unpacks the contents of a gzipped file, all its members, into `text`. False where that is more
/// than `most` bytes, or the contents are damaged; `problem` then says what is wrong. Never holds
/// more than `most` bytes and a block.
bool unpack_gzip(std::string_view contents, std::size_t most, std::string& text,
                 std::string& problem);

}  // namespace navjit::gdml
