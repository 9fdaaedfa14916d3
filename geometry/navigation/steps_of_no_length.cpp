#include "geometry/navigation/steps_of_no_length.hpp"

#include <algorithm>

#include "geometry/navigation/generic.hpp"
#include "geometry/navigation/packed_daughter.hpp"

namespace navjit {
namespace {

using kernels::Context;

const Geometry& geometry_of(const Context* context) {
  return *static_cast<const Geometry*>(context->geometry);
}

/// As generic::relocate_in_own_frames(), but through the dispatch table. The navigator of the
/// innermost volume finds the next touchable as after any other step. That is the right one if each
/// volume that was entered contains the point in its own frame, too: only those that do not are
/// passed over.
void relocate(NavigationStack* stack, const Context* context, double x, double y, double z,
              int blocked) {
  const int depth = stack->depth;
  TouchableId before[kernels::stack_levels];
  for (int i = 0; i <= depth; ++i) before[i] = stack->levels[i].touchable;
  kernels::relocate_in_table(stack, context, stack->levels[depth].volume, x, y, z, blocked);
  const Geometry& geometry = geometry_of(context);
  const double* const u = stack->ray.given;
  int i = 0;  // the first level that was entered: what was left must not be entered again
  const int shared = std::min(depth, stack->depth);
  while (i <= shared && stack->levels[i].touchable == before[i]) ++i;
  for (; i <= stack->depth; ++i) {
    const StackLevel& level = stack->levels[i];
    if (generic::contains_here(
            geometry.packed(level.volume).solid, kernels::to_local(level, x, y, z),
            kernels::to_local_heading(level, u[0], u[1], u[2]), geometry.tolerance())) {
      continue;
    }
    generic::restore(geometry, *stack, before[depth]);
    generic::relocate_in_own_frames(geometry, *stack, {x, y, z}, {u[0], u[1], u[2]}, blocked);
    return;
  }
}

}  // namespace

void leave_at_once(NavigationStack* stack, const Context* context, double x, double y, double z) {
  stack->boundary = 1;
  const int left = static_cast<int>(stack->levels[stack->depth].daughter);
  if (--stack->depth >= 0) relocate(stack, context, x, y, z, left);
  // It was within the tolerance of its end and no farther: the ray may come into it again.
  stack->left.daughter = kernels::LeftForGood::none;
  stack->left.from = -1;
}

double return_at_once(NavigationStack* stack, const Context* context, double x, double y,
                      double z) {
  constexpr double unknown = -1;
  const Geometry& geometry = geometry_of(context);
  const double tolerance = geometry.tolerance();
  const StackLevel& level = stack->levels[stack->depth];
  const PackedScene& scene = geometry.packed(level.volume);
  // The place behind the innermost level may be left from an earlier step: it is only a guess.
  const unsigned left = stack->levels[stack->depth + 1].daughter;
  if (left >= scene.count || scene.lists == nullptr) return unknown;
  const Vec3 p = kernels::to_local(level, x, y, z);
  const NeighbourLists::Of& around = scene.lists[left];
  if (!is_there(around, p) || !around.listed()) return unknown;
  const double* const u = stack->ray.given;
  const Direction v = level.rotation == nullptr
                          ? stack->ray.direction
                          : kernels::to_local_direction(level, u[0], u[1], u[2]);
  const Vec3 point{x, y, z};
  const generic::InOwnFrame in_own_frame{*stack, scene, point, stack->ray.direction, tolerance};
  const double distance = generic::distance_local(scene.daughters[left], p, v, tolerance);
  if (distance != 0 || !in_own_frame(left)) return unknown;
  // Of several the first in file order is entered. All that hold the point are neighbours.
  const std::uint32_t* const neighbours = scene.neighbours + around.first;
  for (std::uint32_t n = 0; n < around.count; ++n) {
    const std::uint32_t k = neighbours[n];
    if (k < left && generic::distance_local(scene.daughters[k], p, v, tolerance) == 0 &&
        in_own_frame(k)) {
      return unknown;
    }
  }
  stack->boundary = 1;
  generic::push(*stack, scene.daughters[left], left);
  relocate(stack, context, x, y, z, -1);
  return distance;
}

}  // namespace navjit
