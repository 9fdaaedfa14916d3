// Unpacks ROOT's compressed blocks.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace navjit::root {

/// The bytes, `size` in all, of a sequence of packed blocks (zlib, LZMA, LZ4, Zstandard, and the
/// deflate of files before 2002). Throws FormatError if they are damaged. Memory is taken as blocks
/// are unpacked, at most 16 MB at once.
std::string unpack(std::string_view blocks, std::size_t size);

}  // namespace navjit::root
