#include "bench/scene_states.hpp"

#include <random>

#include "geometry/model/random.hpp"
#include "geometry/navigation/generic.hpp"
#include "runtime/states.hpp"

namespace navjit::bench {
namespace {

constexpr std::size_t most_touchables = 64;
constexpr std::size_t attempts_per_ray = 2000;

Transformation frame_of(const Geometry& geometry, TouchableId touchable) {
  kernels::NavigationStack stack{};
  stack.depth = -1;
  generic::restore(geometry, stack, touchable);
  const kernels::StackLevel& level = stack.levels[stack.depth];
  Transformation frame;
  std::copy_n(level.translation, 3, frame.translation);
  if (level.rotation != nullptr) std::copy_n(level.rotation, 9, frame.rotation);
  return frame;
}

}  // namespace

std::vector<SceneRay> rays_in_volume(Runtime& runtime, VolumeId volume, std::size_t count,
                                     std::uint64_t seed) {
  const Geometry geometry(runtime.share_world());
  const StateSampler sampler(geometry);
  std::mt19937_64 random(seed);
  std::vector<std::pair<TouchableId, Transformation>> places;
  for (std::size_t i = 0; i < most_touchables; ++i) {
    TouchableId touchable = 0;
    if (!sampler.touchable(volume, random, touchable)) return {};
    places.emplace_back(touchable, frame_of(geometry, touchable));
  }
  Navigator navigator = runtime.navigator();
  const Extent& extent = geometry.world().volumes[volume].solid.extent;
  std::vector<SceneRay> rays;
  for (std::size_t attempt = 0; attempt < attempts_per_ray * count && rays.size() < count;
       ++attempt) {
    const auto& [touchable, frame] = places[random() % places.size()];
    const Vec3 local{uniform(random, extent.min.x, extent.max.x),
                     uniform(random, extent.min.y, extent.max.y),
                     uniform(random, extent.min.z, extent.max.z)};
    const Ray ray{to_outer(frame, local), unit_vector(random)};
    const State state = navigator.locate(ray.position, ray.direction);
    if (state.inside() && state.touchable() == touchable) rays.push_back({ray, state});
  }
  return rays;
}

}  // namespace navjit::bench
