// A key by which solids are compared.
#pragma once

#include <string>

#include "geometry/solids/solid.hpp"

namespace navjit {

/// Bytes that are equal for solids of equal kind and dimensions, whatever their names. There are
/// about eight for each number, so the length tells how many numbers code would have.
std::string solid_key(const kernels::AnySolid<double>& solid);

}  // namespace navjit
