#include "geometry/printable.hpp"

#include <algorithm>

namespace navjit {

std::string printable(std::string_view text, std::size_t longest) {
  std::size_t length = std::min(text.size(), longest);
  // Do not cut within a UTF-8 character.
  while (length > 0 && length < text.size() && (text[length] & 0xc0) == 0x80) --length;
  std::string line(text.substr(0, length));
  for (char& c : line) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = '?';
  }
  if (length < text.size()) line += "...";
  return line;
}

}  // namespace navjit
