// Regular arrangements of daughters, named.
#pragma once

#include <span>
#include <string>

#include "geometry/solids/solid.hpp"

namespace navjit {

/// "leaf", "single", "stack of 70 along z", "grid 4 x 4 x 1", or "N daughters": what a reader would
/// call the arrangement of these boxes. For display; navigation never depends on it.
std::string describe_pattern(std::span<const Extent> boxes);

}  // namespace navjit
