// Whether a world is ready to be navigated.
#pragma once

#include "geometry/model/world.hpp"

namespace navjit {

/// Whether finish() was called and nothing changed since that it checks or sets: what navigation
/// relies on.
bool is_finished(const World& world);

}  // namespace navjit
