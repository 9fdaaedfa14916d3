// Names from files, as they are written for people and for programs.
#pragma once

#include <string>
#include <string_view>

namespace navjit::common {

/// A field of a CSV file: in quotes where RFC 4180 asks for them (comma, quote, CR, LF).
std::string csv_field(std::string_view text);

/// What of a text a terminal can be trusted with: one line, without characters that steer it. They
/// become \n, \t, \x1b, \u{202e}; bytes that are no UTF-8 \xff.
std::string printable(std::string_view text);

/// Columns that a printable text takes on a terminal.
std::size_t columns(std::string_view text);

/// printable(text) in exactly `width` columns: with spaces after it or, where it is too long, with
/// its end after "...". width >= 3.
std::string fitted(std::string_view text, std::size_t width);

}  // namespace navjit::common
