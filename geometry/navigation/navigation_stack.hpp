// The navigation stack (navjit/detail/navigation_stack.h) for code compiled with the library.
#pragma once

#include "geometry/model/world.hpp"

// clang-format off
#include "navjit/detail/navigation_stack.h"
#include "geometry/kernels/navigation.h"
// clang-format on

namespace navjit {

using kernels::NavigationStack;
using kernels::StackLevel;
static_assert(kernels::stack_levels == max_depth);

/// Compares what a navigator may read: the depth, and the volume, touchable and frame of every
/// level, bit for bit.
bool identical(const NavigationStack& a, const NavigationStack& b);

/// Brings the stack to the world volume, with no other level on it.
void enter_world(NavigationStack& stack, VolumeId top);

/// Pushes a daughter of the innermost level, by its placement.
inline void push(NavigationStack& stack, const Transformation& t, VolumeId volume,
                 unsigned daughter, TouchableId offset) {
  if (t.rotated) {
    kernels::push_rotated(&stack, volume, daughter, offset, t.translation[0], t.translation[1],
                          t.translation[2], t.rotation);
  } else {
    kernels::push_translated(&stack, volume, daughter, offset, t.translation[0], t.translation[1],
                             t.translation[2]);
  }
}

/// The transformation from the world into a level.
Transformation frame_of(const StackLevel& level);

/// Copies a stack; the rotations of the copy point into the copy.
void copy(const NavigationStack& from, NavigationStack& to);

}  // namespace navjit
