// How elements are looked up, and how messages name them.
#include "geometry/gdml/xml.hpp"

namespace navjit::gdml {

std::optional<std::string_view> XmlElement::find(std::string_view attribute) const {
  for (std::size_t i = 0; i < attribute_count; ++i) {
    if (attributes[i].name == attribute) return attributes[i].value;
  }
  return std::nullopt;
}

std::string label(const XmlElement& element) {
  std::string text = '<' + printable(element.tag);
  for (const char* attribute : {"name", "ref", "for"}) {
    if (const auto value = element.find(attribute)) {
      return text + ' ' + attribute + "='" + printable(*value) + "'>";
    }
  }
  return text + '>';
}

std::string describe(const XmlElement& element) {
  return printable_path(*element.file) + ':' + std::to_string(element.line) + ": " + label(element);
}

void fail(const XmlElement& element, const std::string& problem) {
  throw GdmlError(describe(element) + ": " + problem);
}

void refuse(const XmlElement& element, const std::string& problem) {
  throw GdmlRefusal(describe(element) + ": " + problem);
}

void fail_needing(const XmlElement& element, const std::string& message) {
  constexpr std::string_view needed = " (needed by ";
  // One element that needs it is named, however long the chain.
  if (message.find(needed) != std::string::npos) throw GdmlError(message);
  throw GdmlError(message + std::string(needed) + describe(element) + ')');
}

}  // namespace navjit::gdml
