// Solids (navjit/solids.hpp) with what they are made of: a kernel's struct in double precision,
// which *is* the definition of the solid.
#pragma once

#include "geometry/solids/any_solid.hpp"
#include "navjit/solids.hpp"

namespace navjit {

using kernels::Side;
using Direction = kernels::Direction<double>;

inline kernels::AnySolid<double> Solid::any() const { return {kind, shape.get()}; }

}  // namespace navjit
