#include "geometry/navigation/left_for_good.hpp"

#include "geometry/navigation/generic.hpp"
#include "geometry/navigation/packed_daughter.hpp"
#include "geometry/navigation/scene.hpp"

namespace navjit {

unsigned find_left_for_good(const Geometry& geometry, const NavigationStack& stack,
                            const Vec3& point) {
  constexpr unsigned none = kernels::LeftForGood::none;
  const double tolerance = geometry.tolerance();
  const unsigned known = kernels::left_for_good(stack, point.x, point.y, point.z, tolerance);
  if (known != none || stack.left.from != stack.depth + 1) return known;
  const StackLevel& level = stack.levels[stack.depth];
  const PackedScene& scene = geometry.packed(level.volume);
  const unsigned left = stack.levels[stack.depth + 1].daughter;
  if (left >= scene.count) return none;
  const PackedDaughter& daughter = scene.daughters[left];
  const Vec3 at = kernels::to_local(level, point.x, point.y, point.z);
  const Vec3 p = generic::local(daughter, at);
  if (inside(daughter.solid, p, tolerance) != Side::surface) return none;
  const bool for_good = kernels::visit(
      daughter.solid, [&](const auto& shape) { return is_left_for_good(shape, p, tolerance); });
  if (for_good) return left;
  if (scene.lists == nullptr || !is_there(scene.lists[left], at)) return none;
  const double* const u = stack.ray.given;
  const Direction v = kernels::to_local_heading(level, u[0], u[1], u[2]);
  return kernels::comes_out_of_box(scene.lists[left], at, v, tolerance) ? left : none;
}

}  // namespace navjit
