// What a ray has left for good (kernels::LeftForGood), found from the geometry.
#pragma once

#include "geometry/navigation/geometry.hpp"
#include "geometry/navigation/navigation_stack.hpp"

namespace navjit {

/// The daughter of the innermost level that the stack's ray has just left for good at this point
/// (mm, in the world); kernels::LeftForGood::none if there is none. Specialised navigators put it
/// on the stack when they leave it; the generic navigator, which asks every daughter, does not. So
/// this finds it where a step is recorded, to see what specialised code would make of it.
unsigned find_left_for_good(const Geometry& geometry, const NavigationStack& stack,
                            const Vec3& point);

}  // namespace navjit
