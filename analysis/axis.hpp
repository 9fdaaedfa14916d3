// A box's bounds along one axis: 0, 1, 2 for x, y, z.
#pragma once

#include "geometry/solids/solid.hpp"

namespace navjit {

inline double low(const Extent& e, int axis) {
  return axis == 0 ? e.min.x : axis == 1 ? e.min.y : e.min.z;
}
inline double high(const Extent& e, int axis) {
  return axis == 0 ? e.max.x : axis == 1 ? e.max.y : e.max.z;
}

}  // namespace navjit
