// The navigation stack (navjit/detail/touchable_stack.h) for compiled-ahead code.
#pragma once

#include "geometry/model/world.hpp"

// clang-format off
#include "navjit/detail/touchable_stack.h"
#include "geometry/kernels/navigation.h"
// clang-format on

namespace navjit {

using kernels::Stack;
using kernels::StackLevel;
static_assert(kernels::stack_levels == max_depth);

/// Compares what a navigator may read: depth, and every level's volume, touchable and frame, bit
/// for bit.
bool identical(const Stack& a, const Stack& b);

/// Puts the stack into the world volume, and nothing else on it.
void enter_world(Stack& stack, VolumeId top);

/// Pushes a daughter of the innermost level, by its placement.
inline void push(Stack& stack, const Transformation& t, VolumeId volume, unsigned daughter,
                 TouchableId offset) {
  if (t.rotated) {
    kernels::push_rotated(&stack, volume, daughter, offset, t.translation[0], t.translation[1],
                          t.translation[2], t.rotation);
  } else {
    kernels::push_translated(&stack, volume, daughter, offset, t.translation[0], t.translation[1],
                             t.translation[2]);
  }
}

/// From the world into a level.
Transformation frame_of(const StackLevel& level);

/// Copies a stack, with the rotations of the copy pointing into the copy.
void copy(const Stack& from, Stack& to);

}  // namespace navjit
