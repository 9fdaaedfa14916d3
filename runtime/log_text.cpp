#include "runtime/log_text.hpp"

namespace navjit {

std::string one_line(std::string_view text, std::size_t most) {
  while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
  std::string line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (line.size() + 3 > most) return line + "...";
    if (c == '\n') {
      line += " | ";
    } else {
      line += static_cast<unsigned char>(c) < ' ' || c == 0x7f ? '?' : c;
    }
  }
  return line;
}

std::string in_quotes(std::string_view text, std::size_t most) {
  std::string value = "\"";
  for (const char c : one_line(text, most)) {
    if (c == '"' || c == '\\') value += '\\';
    value += c;
  }
  return value + '"';
}

}  // namespace navjit
