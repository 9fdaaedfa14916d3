#include "geometry/root/names.hpp"

#include <cstdint>

#include "geometry/root/bytes.hpp"

namespace navjit::root {
namespace {

unsigned char byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

/// The length in bytes of the UTF-8 character that begins there; 0 if there is none.
std::size_t character_at(std::string_view text, std::size_t i) {
  const unsigned char first = byte_at(text, i);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || length > text.size() - i) return 0;
  std::uint32_t code = first & (0x7fU >> length);
  for (std::size_t k = 1; k < length; ++k) {
    const unsigned char next = byte_at(text, i + k);
    if ((next & 0xc0) != 0x80) return 0;
    code = code << 6 | (next & 0x3fU);
  }
  constexpr std::uint32_t first_of_length[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  // The last two codes of each plane are no characters; XML does not allow them.
  const bool none = (code & 0xfffe) == 0xfffe;
  return code < first_of_length[length] || code > 0x10ffff || surrogate || none ? 0 : length;
}

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_at(text, i);
    if (length == 0) return false;
    i += length;
  }
  return true;
}

}  // namespace

std::string readable(std::string_view name) {
  constexpr std::size_t longest = 65'536;
  if (name.size() > longest) throw FormatError("a name has more than 65536 bytes");
  const bool utf8 = is_utf8(name);
  std::string text;
  text.reserve(name.size());
  for (std::size_t i = 0; i < name.size(); ++i) {
    const unsigned char byte = byte_at(name, i);
    if (byte < 0x20 || byte == 0x7f) {
      text += '?';
    } else if (utf8 || byte < 0x80) {
      text += name[i];
    } else {
      text += static_cast<char>(0xc0 | byte >> 6);
      text += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return text;
}

}  // namespace navjit::root
