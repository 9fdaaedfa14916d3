#include "geometry/gdml/write/xml_text.hpp"

#include <charconv>

namespace navjit::gdml {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      // Written as themselves they would be read as spaces.
      case '\n':
        out += "&#10;";
        break;
      case '\r':
        out += "&#13;";
        break;
      case '\t':
        out += "&#9;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string number_text(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

std::string attribute(std::string_view name, std::string_view text) {
  return ' ' + std::string(name) + "=\"" + escaped(text) + '"';
}

std::string attributes(Numbers numbers) {
  std::string out;
  for (const auto& [name, value] : numbers) out += attribute(name, number_text(value));
  return out;
}

}  // namespace navjit::gdml
