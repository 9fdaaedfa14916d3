#include "common/numbers.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <string>

#include "navjit/errors.hpp"

namespace navjit::common {
namespace {

[[noreturn]] void refuse(std::string_view text, const std::string& why) {
  throw UsageError("'" + std::string(text) + "' " + why);
}

bool digit(char c) { return c >= '0' && c <= '9'; }

/// A decimal number: digits without their point, and the power of ten that they are of.
struct Decimal {
  std::string digits;
  int exponent = 0;
};

/// False for what is no decimal number without sign.
bool parse_decimal(std::string_view text, Decimal& decimal) {
  std::size_t at = 0;
  bool point = false, any = false;
  for (; at < text.size() && (digit(text[at]) || (text[at] == '.' && !point)); ++at) {
    if (text[at] == '.') {
      point = true;
      continue;
    }
    any = true;
    decimal.exponent -= point ? 1 : 0;
    if (text[at] != '0' || !decimal.digits.empty()) decimal.digits += text[at];
  }
  if (!any) return false;
  if (at == text.size()) return true;
  if (text[at] != 'e' && text[at] != 'E') return false;
  ++at;
  if (at < text.size() && text[at] == '+') ++at;
  int exponent = 0;
  const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), exponent);
  if (error == std::errc::invalid_argument || end != text.data() + text.size()) return false;
  if (error != std::errc{} || std::abs(exponent) > 100000) {
    exponent = text[at] == '-' ? -100000 : 100000;
  }
  decimal.exponent += exponent;
  return true;
}

}  // namespace

std::uint64_t parse_count(std::string_view text, std::uint64_t least, std::uint64_t most) {
  const auto too_much = [&] { refuse(text, "is more than " + std::to_string(most)); };
  Decimal decimal;
  if (text.size() > 1 && text[0] == '-' && parse_decimal(text.substr(1), decimal)) {
    refuse(text, "is negative");
  }
  if (!parse_decimal(text, decimal)) refuse(text, "is not a whole number, such as 1000 or 1e6");
  std::string& digits = decimal.digits;
  for (; decimal.exponent < 0 && !digits.empty() && digits.back() == '0'; ++decimal.exponent) {
    digits.pop_back();
  }
  if (decimal.exponent < 0 && !digits.empty()) refuse(text, "is not a whole number");
  constexpr std::size_t most_digits = std::numeric_limits<std::uint64_t>::digits10;
  if (!digits.empty()) {
    if (digits.size() + static_cast<std::size_t>(decimal.exponent) > most_digits + 1) too_much();
    digits.append(static_cast<std::size_t>(decimal.exponent), '0');
  }
  std::uint64_t value = 0;
  for (const char c : digits) {
    const auto d = static_cast<std::uint64_t>(c - '0');
    if (value > (std::numeric_limits<std::uint64_t>::max() - d) / 10) too_much();
    value = 10 * value + d;
  }
  if (value < least) refuse(text, "is less than " + std::to_string(least));
  if (value > most) too_much();
  return value;
}

double parse_number(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const std::size_t sign = text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0;
  const auto [at, error] = std::from_chars(text.data() + sign, end, value);
  if (error == std::errc::result_out_of_range) refuse(text, "is too large or too small a number");
  if (error != std::errc{} || at != end || !std::isfinite(value)) {
    refuse(text, "is not a finite number");
  }
  return value;
}

bool looks_like_number(std::string_view text) {
  if (text.empty()) return false;
  const std::size_t sign = text[0] == '-' || text[0] == '+' ? 1 : 0;
  if (sign == text.size()) return false;
  return text.find_first_not_of("0123456789.eE+-") == std::string_view::npos &&
         (digit(text[sign]) ||
          (text[sign] == '.' && sign + 1 < text.size() && digit(text[sign + 1])));
}

}  // namespace navjit::common
