#include "geometry/navigation/navigation_stack.hpp"

#include <algorithm>
#include <cstring>

namespace navjit {

bool identical(const NavigationStack& a, const NavigationStack& b) {
  if (a.depth != b.depth) return false;
  for (int i = 0; i <= a.depth; ++i) {
    const StackLevel &x = a.levels[i], &y = b.levels[i];
    if (x.touchable != y.touchable || x.volume != y.volume || x.daughter != y.daughter) {
      return false;
    }
    // Values and not bytes: the sign of a zero in a frame changes no answer (docs/numerics.md).
    for (int j = 0; j < 3; ++j) {
      if (x.translation[j] != y.translation[j]) return false;
    }
    constexpr double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const double* p = x.rotation != nullptr ? x.rotation : identity;
    const double* q = y.rotation != nullptr ? y.rotation : identity;
    for (int j = 0; j < 9; ++j) {
      if (p[j] != q[j]) return false;
    }
  }
  return true;
}

void enter_world(NavigationStack& stack, VolumeId top) {
  stack.depth = 0;
  StackLevel& level = stack.levels[0];
  level = {};
  level.volume = top;
}

Transformation frame_of(const StackLevel& level) {
  Transformation frame;
  std::copy_n(level.translation, 3, frame.translation);
  frame.rotated = level.rotation != nullptr;
  if (frame.rotated) std::copy_n(level.rotation, 9, frame.rotation);
  return frame;
}

void copy(const NavigationStack& from, NavigationStack& to) {
  to.depth = from.depth;
  to.boundary = from.boundary;
  to.left = {};  // it belongs to the ray, which is not copied
  for (int i = 0; i <= from.depth; ++i) {
    to.levels[i] = from.levels[i];
    const double* rotation = from.levels[i].rotation;
    for (int j = 0; j <= i; ++j) {
      if (rotation == from.levels[j].own_rotation) {
        to.levels[i].rotation = to.levels[j].own_rotation;
      }
    }
  }
}

}  // namespace navjit
