#include "apps/accuracy/levels.hpp"

#include <algorithm>
#include <bit>

#include "geometry/model/world.hpp"
#include "navjit/search.hpp"

namespace navjit::accuracy {
namespace {

constexpr NavigatorLevel levels[] = {
    {"generic", JitMode::off},
    {"exact", JitMode::wait},
};

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_step(const MadeStep& a, const MadeStep& b) {
  return same_bits(a.length, b.length) && a.touchable == b.touchable && a.volume == b.volume;
}

RuntimeOptions options_of(const NavigatorLevel& level, const GeometryOptions& geometry) {
  RuntimeOptions options;
  options.jit = level.jit;
  options.geometry = geometry;
  return options;
}

}  // namespace

std::span<const NavigatorLevel> navigator_levels() { return levels; }

LevelEngine::LevelEngine(std::shared_ptr<const World> world, const NavigatorLevel& level,
                         const GeometryOptions& options)
    : level_(level),
      runtime_(std::make_unique<Runtime>(std::move(world), options_of(level, options))) {}

MadeRay make_ray_steps(Navigator& navigator, const World& world, const Ray& ray,
                       std::size_t index) {
  MadeRay made;
  made.index = index;
  Vec3 point = ray.position;
  const RayTotals totals =
      transport(navigator, ray, world.tolerance, [&](const State& state, double length) {
        made.steps.push_back(
            {point, length, world.volumes[state.volume()].name, state.touchable()});
        // As transport() moves on.
        point.x += length * ray.direction.x;
        point.y += length * ray.direction.y;
        point.z += length * ray.direction.z;
      });
  made.end = point;
  made.stuck = totals.stuck;
  return made;
}

bool identical(const MadeRay& a, const MadeRay& b) {
  return a.stuck == b.stuck && a.steps.size() == b.steps.size() &&
         equal_steps(a, b) == b.steps.size();
}

std::size_t equal_steps(const MadeRay& a, const MadeRay& b) {
  std::size_t equal = 0;
  for (std::size_t i = 0; i < std::min(a.steps.size(), b.steps.size()); ++i) {
    equal += same_step(a.steps[i], b.steps[i]) ? 1 : 0;
  }
  return equal;
}

}  // namespace navjit::accuracy
