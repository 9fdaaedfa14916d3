// Solids that no code can be made for.
#pragma once

#include "geometry/navigation/geometry.hpp"

namespace navjit {

/// Whether the solid is a foreign one, or is made of such.
bool is_foreign(const kernels::AnySolid<double>& solid);

/// Whether the volume's own solid or a daughter's is a foreign one, or is made of such.
bool holds_foreign(const Scene& scene);

}  // namespace navjit
