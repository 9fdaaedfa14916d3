#include "codegen/text.hpp"

#include <charconv>
#include <cmath>

namespace navjit::codegen {

std::string number(double value) {
  if (std::isinf(value)) return value > 0 ? "__builtin_inf()" : "-__builtin_inf()";
  if (std::isnan(value)) return "__builtin_nan(\"\")";
  // to_chars does not depend on the program's locale.
  char text[40];
  const auto written =
      std::to_chars(text, text + sizeof text, std::abs(value), std::chars_format::hex);
  return (std::signbit(value) ? "-0x" : "0x") + std::string(text, written.ptr);
}

std::string identifier(std::string_view name) {
  std::string out;
  for (const char c : name.substr(0, 60)) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    out += plain ? c : '_';
  }
  return out;
}

}  // namespace navjit::codegen
