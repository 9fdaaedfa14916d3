// The navigation stack (kernels/navigation.h) for compiled-ahead code.
#pragma once

#include "geometry/model/world.hpp"

// clang-format off
#include "geometry/kernels/navigation.h"
// clang-format on

namespace navjit {

using kernels::Stack;
using kernels::StackLevel;
static_assert(kernels::stack_levels == max_depth);

/// Compares what a navigator may read: depth, and every level's volume, touchable and frame, bit
/// for bit.
bool identical(const Stack& a, const Stack& b);

/// Copies a stack, with the rotations of the copy pointing into the copy.
void copy(const Stack& from, Stack& to);

}  // namespace navjit
