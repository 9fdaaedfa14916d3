// Solids that cannot be made.
#pragma once

#include <string>

#include "navjit/errors.hpp"

namespace navjit {

/// Why make() fails; "accepted" if it does not.
template <class Make>
std::string refusal(Make make) {
  try {
    make();
  } catch (const GeometryError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace navjit
