#include "common/text.hpp"

#include <cstdint>
#include <cstdio>

namespace navjit::common {
namespace {

/// The character at the begin of a text, and its bytes; size 0 if it is not UTF-8.
struct Character {
  char32_t code = 0;
  std::size_t size = 0;
};

Character first_of(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t size = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < size) return {};
  char32_t code = lead & (0x7fU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fU);
  }
  const bool overlong = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
  const bool none = code > 0x10ffff || (code >= 0xd800 && code < 0xe000);
  return overlong || none ? Character{} : Character{code, size};
}

/// Controls, and what turns the direction of writing or breaks lines.
bool steers(char32_t c) {
  return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x61c || (c >= 0x200b && c <= 0x200f) ||
         (c >= 0x2028 && c <= 0x202e) || (c >= 0x2060 && c <= 0x206f) || c == 0xfeff;
}

struct Range {
  char32_t first, last;
};
/// The blocks of Unicode whose characters take no column, and two: near enough for a table.
constexpr Range combining[]{{0x300, 0x36f},   {0x483, 0x489},   {0x591, 0x5bd},   {0x610, 0x61a},
                            {0x64b, 0x65f},   {0x1ab0, 0x1aff}, {0x1dc0, 0x1dff}, {0x20d0, 0x20ff},
                            {0xfe00, 0xfe0f}, {0xfe20, 0xfe2f}};
constexpr Range wide[]{{0x1100, 0x115f},   {0x2e80, 0x303e},  {0x3041, 0x33ff}, {0x3400, 0x4dbf},
                       {0x4e00, 0x9fff},   {0xa000, 0xa4cf},  {0xac00, 0xd7a3}, {0xf900, 0xfaff},
                       {0xfe30, 0xfe6f},   {0xff00, 0xff60},  {0xffe0, 0xffe6}, {0x1f300, 0x1f64f},
                       {0x1f900, 0x1f9ff}, {0x20000, 0x3fffd}};

template <std::size_t n>
bool within(const Range (&ranges)[n], char32_t c) {
  for (const Range& range : ranges) {
    if (c >= range.first && c <= range.last) return true;
  }
  return false;
}

std::size_t width_of(char32_t c) { return within(combining, c) ? 0 : within(wide, c) ? 2 : 1; }

std::string escaped(char32_t c) {
  if (c == '\n') return "\\n";
  if (c == '\r') return "\\r";
  if (c == '\t') return "\\t";
  char text[16];
  std::snprintf(text, sizeof text, c < 0x80 ? "\\x%02x" : "\\u{%x}", static_cast<unsigned>(c));
  return text;
}

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + '"';
}

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const Character c = first_of(text);
    if (c.size == 0) {
      char byte[8];
      std::snprintf(byte, sizeof byte, "\\x%02x", static_cast<unsigned char>(text[0]));
      result += byte;
      text.remove_prefix(1);
      continue;
    }
    if (steers(c.code)) {
      result += escaped(c.code);
    } else {
      result += text.substr(0, c.size);
    }
    text.remove_prefix(c.size);
  }
  return result;
}

std::size_t columns(std::string_view text) {
  std::size_t count = 0;
  while (!text.empty()) {
    const Character c = first_of(text);
    count += c.size == 0 ? 1 : width_of(c.code);
    text.remove_prefix(c.size == 0 ? 1 : c.size);
  }
  return count;
}

std::string fitted(std::string_view text, std::size_t width) {
  std::string line = printable(text);
  std::size_t count = columns(line);
  if (count > width) {
    std::string_view rest = line;
    // What is left begins with a character of its own, not with an accent of one that is gone.
    while (count + 3 > width || (!rest.empty() && width_of(first_of(rest).code) == 0)) {
      const Character c = first_of(rest);
      count -= width_of(c.code);
      rest.remove_prefix(c.size);
    }
    line = "..." + std::string(rest);
    count += 3;
  }
  return line + std::string(width - count, ' ');
}

}  // namespace navjit::common
