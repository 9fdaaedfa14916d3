#pragma once

#include <array>
#include <initializer_list>
#include <string>
#include <string_view>

namespace navjit::cache {

using Digest = std::array<unsigned char, 32>;

/// SHA-256 of the parts, each preceded by its length, so that no two lists of parts give the same
/// bytes. Throws Error if the cryptographic library does not work.
Digest sha256_of_parts(std::initializer_list<std::string_view> parts);

/// SHA-256 (FIPS 180-4) of the bytes as they are. Throws as above.
Digest sha256(std::initializer_list<std::string_view> bytes);

/// In lower-case hexadecimal digits.
std::string hex(const Digest& digest);

}  // namespace navjit::cache
