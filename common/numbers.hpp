// Numbers as people write them on a command line: decimal ones, whole and finite where asked for.
#pragma once

#include <cstdint>
#include <string_view>

namespace navjit::common {

/// More of anything takes years.
constexpr std::uint64_t most_counted = 1'000'000'000'000'000;

/// "1000", "1e6", "2.5e3": a whole number from `least` to `most`. Throws UsageError that
/// says what is wrong with it.
std::uint64_t parse_count(std::string_view text, std::uint64_t least = 1,
                          std::uint64_t most = most_counted);

/// A finite decimal number. Throws UsageError.
double parse_number(std::string_view text);

/// Whether a text can only be meant as a number; any other text is the name of a file.
bool looks_like_number(std::string_view text);

}  // namespace navjit::common
