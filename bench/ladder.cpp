#include "bench/ladder.hpp"

#include <algorithm>
#include <limits>

#include "geometry/navigation/generic.hpp"
#include "geometry/navigation/packed_daughter.hpp"
#include "navjit/detail/standing.hpp"

namespace navjit::bench {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

Vec3 moved(const Vec3& point, double length, const Vec3& direction) {
  return {point.x + length * direction.x, point.y + length * direction.y,
          point.z + length * direction.z};
}

/// Whether the innermost level contains the global point.
bool innermost_contains(const Geometry& geometry, const NavigationStack& stack, const Vec3& point,
                        const Vec3& direction) {
  const StackLevel& level = stack.levels[stack.depth];
  return generic::contains_here(
      geometry.packed(level.volume).solid, kernels::to_local(level, point.x, point.y, point.z),
      kernels::to_local_heading(level, direction.x, direction.y, direction.z),
      geometry.tolerance());
}

}  // namespace

const char* name_of(Rung rung) {
  switch (rung) {
    case Rung::frames:
      return "frames composed level by level, on a stack";
    case Rung::nearest:
      return "the way out of the volume asked for in every step";
    case Rung::containment:
      return "containment after every crossing";
    case Rung::search:
      return "search: nothing is known beforehand (the generic navigator's function)";
  }
  return "";
}

Ladder::Ladder(const Geometry& geometry, const std::vector<Ray>& rays) : geometry_(&geometry) {
  NavigationStack stack{};
  for (const Ray& ray : rays) {
    generic::locate(geometry, stack, ray.position, ray.direction);
    if (stack.depth < 0) continue;
    Start start{ray, stack.levels[stack.depth].touchable, 0};
    Vec3 point = ray.position;
    detail::Standing standing;
    while (stack.depth >= 0 && !standing.stuck()) {
      const int depth = stack.depth;
      std::vector<TouchableId> before;
      for (int i = 0; i <= depth; ++i) before.push_back(stack.levels[i].touchable);
      const double length = generic::step(geometry, stack, point, ray.direction, unlimited);
      standing.count(length, geometry.tolerance());
      // A volume that is left and entered again at the same place is both left and entered here.
      int common = 0;
      while (common <= std::min(depth, stack.depth) &&
             before[static_cast<std::size_t>(common)] == stack.levels[common].touchable) {
        ++common;
      }
      const bool entered = stack.depth > depth && common == depth + 1;
      if (!entered) common = std::min(common, depth);
      for (int i = depth; i >= common; --i) moves_.push_back(-1);
      for (int i = common; i <= stack.depth; ++i) {
        moves_.push_back(static_cast<std::int32_t>(stack.levels[i].daughter));
      }
      const std::int32_t hit =
          entered ? static_cast<std::int32_t>(stack.levels[depth + 1].daughter) : -1;
      steps_.push_back({hit, static_cast<std::uint32_t>(moves_.size())});
      point = moved(point, length, ray.direction);
    }
    start.end = steps_.size();
    starts_.push_back(start);
  }
}

template <Rung rung>
Ladder::Sums Ladder::climb() const {
  const Geometry& geometry = *geometry_;
  const double tolerance = geometry.tolerance();
  NavigationStack stack{};
  stack.depth = -1;
  Sums sums;
  std::size_t i = 0, move = 0;
  for (const Start& start : starts_) {
    stack.depth = -1;
    generic::restore(geometry, stack, start.touchable);
    Vec3 point = start.ray.position;
    const Vec3 direction = start.ray.direction;
    for (; i < start.end; ++i) {
      const RecordedStep& recorded = steps_[i];
      double length;
      if constexpr (rung == Rung::search) {
        length = generic::step(geometry, stack, point, direction, unlimited);
      } else {
        kernels::set_ray(stack, direction.x, direction.y, direction.z);
        const StackLevel& level = stack.levels[stack.depth];
        const PackedScene& scene = geometry.packed(level.volume);
        const Vec3 p = kernels::to_local(level, point.x, point.y, point.z);
        const Direction v =
            level.rotation == nullptr
                ? stack.ray.direction
                : kernels::to_local_direction(level, direction.x, direction.y, direction.z);
        length = unlimited;
        if (rung >= Rung::nearest || recorded.hit < 0) {
          length = generic::distance_out_here(scene.solid, p, v, tolerance);
        }
        if (recorded.hit >= 0) {
          length = std::min(
              length, generic::distance_local(scene.daughters[recorded.hit], p, v, tolerance));
        }
        const Vec3 end = moved(point, length, direction);
        bool known = recorded.hit >= 0;  // the daughter that is met contains the point there
        for (; move < recorded.moves_end; ++move) {
          const std::int32_t daughter = moves_[move];
          if (daughter < 0) {
            --stack.depth;
          } else {
            const PackedScene& mother = geometry.packed(stack.levels[stack.depth].volume);
            generic::push(stack, mother.daughters[daughter], static_cast<unsigned>(daughter));
          }
          if (rung >= Rung::containment && !known && stack.depth >= 0) {
            ++sums.checks;
            sums.denied += innermost_contains(geometry, stack, end, direction) ? 0 : 1;
          }
          known = false;
        }
      }
      sums.length += length;
      if (stack.depth >= 0) sums.touchables += stack.levels[stack.depth].touchable;
      point = moved(point, length, direction);
    }
  }
  return sums;
}

Ladder::Sums Ladder::run(Rung rung) const {
  switch (rung) {
    case Rung::frames:
      return climb<Rung::frames>();
    case Rung::nearest:
      return climb<Rung::nearest>();
    case Rung::containment:
      return climb<Rung::containment>();
    case Rung::search:
      return climb<Rung::search>();
  }
  return {};
}

}  // namespace navjit::bench
