#include "runtime/states.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/model/random.hpp"
#include "geometry/navigation/generic.hpp"

namespace navjit {
namespace {

/// Placements remembered per volume: enough for variety.
constexpr std::size_t most_placements = 64;

}  // namespace

StateSampler::StateSampler(const Geometry& geometry)
    : geometry_(geometry), placements_(geometry.size()) {
  // Only mothers that are in the tree count: walk it from the top.
  std::vector<char> seen(geometry.size(), 0);
  std::vector<VolumeId> pending{geometry.world().top};
  seen[geometry.world().top] = 1;
  while (!pending.empty()) {
    const VolumeId mother = pending.back();
    pending.pop_back();
    for (const Daughter& d : geometry.scene(mother).daughters) {
      auto& known = placements_[d.volume];
      if (known.size() < most_placements) known.push_back({mother, d.offset});
      if (!seen[d.volume]) {
        seen[d.volume] = 1;
        pending.push_back(d.volume);
      }
    }
  }
}

bool StateSampler::touchable(VolumeId volume, std::mt19937_64& random, TouchableId& result) const {
  result = 0;
  while (volume != geometry_.world().top) {
    const auto& known = placements_[volume];
    if (known.empty()) return false;
    const Placed& placed = known[random() % known.size()];
    result += placed.offset;
    volume = placed.mother;
  }
  return true;
}

std::vector<Sample> StateSampler::states(VolumeId volume, std::size_t count,
                                         std::uint64_t seed) const {
  std::mt19937_64 random(seed);
  std::vector<Sample> samples;
  const Scene& scene = geometry_.scene(volume);
  const World& world = geometry_.world();
  const Extent& extent = world.volumes[volume].solid.extent;
  NavigationStack stack{};
  stack.depth = -1;
  for (std::size_t attempt = 0; attempt < 20 * count && samples.size() < count; ++attempt) {
    Sample sample{0, volume, {}, unit_vector(random), INFINITY};
    if (!touchable(volume, random, sample.touchable)) break;
    // A point of the mother's box, or of a daughter's, moved onto one of its faces half the time.
    Vec3 local;
    const auto in_box = [&](const Extent& e) {
      Vec3 p{uniform(random, e.min.x, e.max.x), uniform(random, e.min.y, e.max.y),
             uniform(random, e.min.z, e.max.z)};
      switch (random() % 12) {
        case 0:
          p.x = e.min.x;
          break;
        case 1:
          p.x = e.max.x;
          break;
        case 2:
          p.y = e.min.y;
          break;
        case 3:
          p.y = e.max.y;
          break;
        case 4:
          p.z = e.min.z;
          break;
        case 5:
          p.z = e.max.z;
          break;
        default:
          break;
      }
      return p;
    };
    if (scene.daughters.empty() || random() % 2 == 0) {
      local = in_box(extent);
    } else {
      sample.left = static_cast<unsigned>(random() % scene.daughters.size());
      const Daughter& d = scene.daughters[sample.left];
      local = to_outer(d.transformation, in_box(world.volumes[d.volume].solid.extent));
    }
    switch (random() % 8) {
      case 0:
        sample.direction = {random() % 2 == 0 ? 1.0 : -1.0, 0, 0};
        break;
      case 1:
        sample.direction = {0, random() % 2 == 0 ? 1.0 : -1.0, 0};
        break;
      case 2:
        sample.direction = {0, 0, random() % 2 == 0 ? 1.0 : -1.0};
        break;
      default:
        break;
    }
    if (random() % 8 == 0) sample.limit = uniform(random, 0, 10);
    generic::restore(geometry_, stack, sample.touchable);
    const kernels::StackLevel& level = stack.levels[stack.depth];
    Transformation frame;
    std::copy_n(level.translation, 3, frame.translation);
    if (level.rotation != nullptr) std::copy_n(level.rotation, 9, frame.rotation);
    sample.point = to_outer(frame, local);
    const Vec3 p = kernels::to_local(level, sample.point.x, sample.point.y, sample.point.z);
    if (inside(scene.solid, p, geometry_.tolerance()) == Side::outside) continue;
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace navjit
