// Solids for which no code can be made.
#pragma once

#include "geometry/navigation/geometry.hpp"

namespace navjit {

/// Whether the solid is foreign, or is composed of foreign solids.
bool is_foreign(const kernels::AnySolid<double>& solid);

/// Whether the volume's own solid or a daughter's is foreign, or is composed of foreign solids.
bool holds_foreign(const Scene& scene);

}  // namespace navjit
