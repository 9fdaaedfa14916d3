// What pages and pictures contain: names from files, and other pictures.
#pragma once

#include <string>
#include <string_view>

namespace navjit::common {

/// A text as XML and HTML may contain it, between tags as well as in quoted attributes: printable()
/// of it, with & < > " ' as entities.
std::string markup(std::string_view text);

/// The bytes as text, for pictures in pages and in SVG files.
std::string base64(const std::string& bytes);

}  // namespace navjit::common
