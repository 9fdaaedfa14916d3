// Reads XML text into a tree of elements that know their file and line.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <memory_resource>
#include <optional>
#include <string>
#include <string_view>

#include "geometry/gdml/read_world.hpp"
#include "geometry/printable.hpp"

namespace navjit::gdml {

struct XmlAttribute {
  std::string_view name, value;
};

/// An element; everything that it points to belongs to its XmlDocument.
struct XmlElement {
  std::string_view tag;
  std::string_view text;  ///< character data, kept for <expression> only
  const std::string* file = nullptr;
  std::uint64_t line = 0;
  const XmlAttribute* attributes = nullptr;
  std::size_t attribute_count = 0;
  const XmlElement* first_child = nullptr;
  const XmlElement* next_sibling = nullptr;

  std::optional<std::string_view> find(std::string_view attribute) const;

  struct Iterator {
    const XmlElement* element;
    const XmlElement& operator*() const { return *element; }
    Iterator& operator++() {
      element = element->next_sibling;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return element != other.element; }
  };
  struct Children {
    const XmlElement* first;
    Iterator begin() const { return {first}; }
    Iterator end() const { return {nullptr}; }
  };
  Children children() const { return {first_child}; }
};

/// Owns a tree in one arena, so that it is freed at once, however deep it is.
struct XmlDocument {
  std::pmr::monotonic_buffer_resource arena;
  std::deque<std::string> files;
  const XmlElement* root = nullptr;
  bool ends_in_junk = false;  ///< there is text or a further element behind the root's end
};

/// What may still be read: shared by a file and its modules.
struct XmlBudget {
  std::size_t bytes;
  std::size_t elements;
};

/// Reads a document with its external entities. `from` is the element that asked for it, which the
/// message names if the file cannot be opened; it may be null. Throws GdmlError.
std::unique_ptr<XmlDocument> parse_xml(const std::filesystem::path& path, const GdmlLimits& limits,
                                       XmlBudget& budget, const XmlElement* from = nullptr);

/// "<tag name='...'>"
std::string label(const XmlElement& element);
/// "FILE:LINE: <tag name='...'>"
std::string describe(const XmlElement& element);
/// The file asks for too much, or for something without an end: this is an error even where nothing
/// uses it.
struct GdmlRefusal : GdmlError {
  using GdmlError::GdmlError;
};

/// Throws GdmlError: "FILE:LINE: <tag name='...'>: problem". If the element is a definition, the
/// error matters only once something uses it.
[[noreturn]] void fail(const XmlElement& element, const std::string& problem);
/// Throws GdmlRefusal with the same message.
[[noreturn]] void refuse(const XmlElement& element, const std::string& problem);
/// Throws GdmlError: the message of the definition that could not be read, and what needs it.
[[noreturn]] void fail_needing(const XmlElement& element, const std::string& message);

}  // namespace navjit::gdml
