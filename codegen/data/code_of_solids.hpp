// Which solids have code of their own.
#pragma once

#include <map>

#include "codegen/data/quick_solid.hpp"

namespace navjit::codegen {

/// Code by the solid's shape. Equal solids may be several shapes, which have the same code.
using CodeOfSolids = std::map<const void*, const kernels::SolidCode*>;

}  // namespace navjit::codegen
