// Which solids have code of their own.
#pragma once

#include <map>

#include "codegen/data/quick_solid.hpp"

namespace navjit::codegen {

/// By the solid's shape: equal solids may be several shapes, with the same code.
using CodeOfSolids = std::map<const void*, const kernels::SolidCode*>;

}  // namespace navjit::codegen
