// Numbers and names as C++ text.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>

namespace navjit::codegen {

/// A double that reads back to the same bits: hexadecimal, or a builtin for infinities.
std::string number(double value);
inline std::string number(int value) { return std::to_string(value); }
inline std::string number(unsigned value) { return std::to_string(value); }
inline std::string number(unsigned long long value) { return std::to_string(value) + "ULL"; }
inline std::string number(bool value) { return value ? "true" : "false"; }
/// Numbers as an initialiser, which is empty if all are zero.
template <class Values>
std::string list(const Values& values) {
  std::string text;
  bool zero = true;
  for (const auto& value : values) {
    const std::string one = number(value);
    text += (text.empty() ? "{" : ", ") + one;
    zero = zero && one == number(std::decay_t<decltype(value)>{});
  }
  return zero ? "{}" : text + "}";
}
/// A name from a file, made harmless: only letters, digits and underscores, at most 60 characters.
std::string identifier(std::string_view name);

}  // namespace navjit::codegen
