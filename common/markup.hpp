// Names from files in pages and pictures.
#pragma once

#include <string>
#include <string_view>

namespace navjit::common {

/// A text as XML and HTML may contain it, between tags as well as in quoted attributes: printable()
/// of it, with & < > " ' as entities.
std::string markup(std::string_view text);

}  // namespace navjit::common
