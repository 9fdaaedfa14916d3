// Solids compared by value.
#pragma once

#include <string>

#include "geometry/solids/solid.hpp"

namespace navjit {

/// Bytes that are equal for solids of equal kind and dimensions, whatever their names; about eight
/// a number, so the length tells how much there would be to spell out.
std::string solid_key(const kernels::AnySolid<double>& solid);

}  // namespace navjit
