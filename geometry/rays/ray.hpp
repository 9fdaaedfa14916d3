// A straight line along which something is transported.
#pragma once

#include "navjit/vector.hpp"

namespace navjit {

struct Ray {
  Vec3 position;   ///< mm
  Vec3 direction;  ///< unit
};

}  // namespace navjit
