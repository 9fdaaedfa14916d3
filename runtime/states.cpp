#include "runtime/states.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/check/chords.hpp"
#include "geometry/model/random.hpp"
#include "geometry/navigation/generic.hpp"
#include "navjit/vector.hpp"

namespace navjit {
namespace {

/// The number of placements that are remembered for each volume, enough for variety.
constexpr std::size_t most_placements = 64;

/// If random points in boxes give less than this share of the states that are asked for, points on
/// lines are tried, which meet even the thinnest shell.
constexpr double few_of = 0.25;

}  // namespace

StateSampler::StateSampler(const Geometry& geometry)
    : geometry_(geometry), placements_(geometry.size()) {
  // Only mothers in the tree count, so it is walked from the top.
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

namespace {

/// A point in the box, moved onto one of the box's faces half the time.
Vec3 point_of(const Extent& e, std::mt19937_64& random) {
  Vec3 p = point_in(random, e);
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
}

/// A point within a solid that may fill almost nothing of its box, on a part of a random line that
/// is within the solid. Nothing if the line misses the solid.
std::optional<Vec3> point_on_chord(const kernels::AnySolid<double>& solid, const Extent& e,
                                   std::mt19937_64& random, double tolerance) {
  const Vec3 through = point_in(random, e);
  Vec3 v = unit_vector(random);
  // Most lines through a flat box are in the box only for a short way, so half of the lines go
  // through two of its points.
  if (random() % 2 == 0) {
    const Vec3 along = point_in(random, e) - through;
    const double length = std::sqrt(dot(along, along));
    if (length > 0) v = 1 / length * along;
  }
  const Vec3 diagonal = e.max - e.min;
  const double before = 1.1 * std::sqrt(dot(diagonal, diagonal));
  const Vec3 begin = through - before * v;
  const std::vector<Chord> chords = chords_along(solid, begin, v, 2 * before, tolerance);
  if (chords.empty()) return std::nullopt;
  const Chord& chord = chords[random() % chords.size()];
  return begin + uniform(random, chord.enter, chord.leave) * v;
}

/// The random direction, or sometimes one along an axis.
Vec3 direction_of(const Vec3& at_random, std::mt19937_64& random) {
  switch (random() % 8) {
    case 0:
      return {random() % 2 == 0 ? 1.0 : -1.0, 0, 0};
    case 1:
      return {0, random() % 2 == 0 ? 1.0 : -1.0, 0};
    case 2:
      return {0, 0, random() % 2 == 0 ? 1.0 : -1.0};
    default:
      return at_random;
  }
}

}  // namespace

std::vector<Sample> StateSampler::states(VolumeId volume, std::size_t count,
                                         std::uint64_t seed) const {
  std::mt19937_64 random(seed);
  std::vector<Sample> samples;
  const Scene& scene = geometry_.scene(volume);
  const World& world = geometry_.world();
  const Extent& extent = world.volumes[volume].solid.extent;
  NavigationStack stack{};
  stack.depth = -1;
  const auto add = [&](Sample sample, const Vec3& local) {
    sample.direction = direction_of(sample.direction, random);
    if (random() % 8 == 0) sample.limit = uniform(random, 0, 10);
    generic::restore(geometry_, stack, sample.touchable);
    const kernels::StackLevel& level = stack.levels[stack.depth];
    Transformation frame;
    std::copy_n(level.translation, 3, frame.translation);
    if (level.rotation != nullptr) std::copy_n(level.rotation, 9, frame.rotation);
    sample.point = to_outer(frame, local);
    const Vec3 p = kernels::to_local(level, sample.point.x, sample.point.y, sample.point.z);
    if (inside(scene.solid, p, geometry_.tolerance()) == Side::outside) return;
    samples.push_back(sample);
  };
  for (std::size_t attempt = 0; attempt < 20 * count && samples.size() < count; ++attempt) {
    Sample sample{0, volume, {}, unit_vector(random), INFINITY};
    if (!touchable(volume, random, sample.touchable)) return samples;
    // A point of the mother's box, or of a daughter's.
    if (scene.daughters.empty() || random() % 2 == 0) {
      add(sample, point_of(extent, random));
    } else {
      sample.left = static_cast<unsigned>(random() % scene.daughters.size());
      const Daughter& d = scene.daughters[sample.left];
      add(sample,
          to_outer(d.transformation, point_of(world.volumes[d.volume].solid.extent, random)));
    }
  }
  if (static_cast<double>(samples.size()) >= few_of * static_cast<double>(count)) return samples;
  for (std::size_t attempt = 0; attempt < 4 * count && samples.size() < count; ++attempt) {
    Sample sample{0, volume, {}, unit_vector(random), INFINITY};
    if (!touchable(volume, random, sample.touchable)) break;
    const auto local = point_on_chord(scene.solid, extent, random, geometry_.tolerance());
    if (local) add(sample, *local);
  }
  return samples;
}

}  // namespace navjit
