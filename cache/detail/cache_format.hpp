// The bytes of a cache entry: docs/cache.md.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cache/sha256.hpp"

namespace navjit::cache::detail {

/// What an entry begins with; numbers are little-endian.
///   0  8  "NAVJITC1": name and version of the format
///   8  8  bytes of content
///  16  8  bytes of label
///  24 32  key
///  56 32  SHA-256 of all other bytes of the file, in order
///  88     label, then content
constexpr std::size_t header_bytes = 88;
constexpr std::size_t max_label_bytes = 200;

/// The header and label of an entry with this content.
std::string make_header(const Digest& key, std::string_view label, std::string_view content);

struct ParsedHeader {
  std::uint64_t content_bytes = 0;
  std::uint64_t label_bytes = 0;
  Digest key{}, checksum{};
  std::string problem;  ///< empty if sound
};

/// Reads the header of a file of `file_bytes`, of which `start` has the first bytes: enough for
/// header and label if the file has them.
ParsedHeader parse_header(std::string_view start, std::uint64_t file_bytes);

/// Why a whole file is no entry; empty if it is one.
std::string check_entry(std::string_view file, const ParsedHeader& header);

/// Printable ASCII, cut to max_label_bytes.
std::string printable(std::string_view text);

}  // namespace navjit::cache::detail
