#include "codegen/text.hpp"

#include <cmath>
#include <cstdio>

namespace navjit::codegen {

std::string number(double value) {
  if (std::isinf(value)) return value > 0 ? "__builtin_inf()" : "-__builtin_inf()";
  if (std::isnan(value)) return "__builtin_nan(\"\")";
  char text[40];
  std::snprintf(text, sizeof text, "%a", value);
  return text;
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
