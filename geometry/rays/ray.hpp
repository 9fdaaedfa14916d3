// A straight line that something is transported along.
#pragma once

#include "navjit/vector.hpp"

namespace navjit {

struct Ray {
  Vec3 position;   ///< mm
  Vec3 direction;  ///< unit
};

}  // namespace navjit
