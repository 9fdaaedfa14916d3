#include "tests/campaign/starts.hpp"

#include <vector>

#include "geometry/model/random.hpp"
#include "navjit/vector.hpp"

namespace navjit::campaign {
namespace {

using Random = std::mt19937_64;

bool chance(Random& random, double p) { return uniform(random, 0, 1) < p; }

Vec3 point_in(Random& random, const Extent& e) {
  return {uniform(random, e.min.x, e.max.x), uniform(random, e.min.y, e.max.y),
          uniform(random, e.min.z, e.max.z)};
}

/// One of the ends, the middle, the origin, or any other value.
double on_lattice(Random& random, double low, double high) {
  switch (random() % 6) {
    case 0:
      return low;
    case 1:
      return high;
    case 2:
      return (low + high) / 2;
    case 3:
      return 0;
    default:
      return uniform(random, low, high);
  }
}

Vec3 unit(const Vec3& v) { return (1 / norm(v)) * v; }

/// Along an axis, nearly so, in a coordinate plane, or along a diagonal.
Vec3 awkward_direction(Random& random) {
  double c[3] = {0, 0, 0};
  const auto sign = [&] { return random() % 2 == 0 ? 1.0 : -1.0; };
  const std::size_t axis = random() % 3, other = (axis + 1 + random() % 2) % 3;
  c[axis] = sign();
  switch (random() % 4) {
    case 0:
      break;
    case 1:
      c[other] = sign() * std::exp(uniform(random, std::log(1e-12), std::log(1e-2)));
      break;
    case 2:
      c[other] = uniform(random, -1, 1);
      break;
    default:
      c[other] = sign();
      if (random() % 2 == 0) c[3 - axis - other] = sign();
  }
  return unit({c[0], c[1], c[2]});
}

/// A touchable, found by a walk down from the world that may stop at each level.
struct Place {
  VolumeId volume;
  std::vector<const Transformation*> frames;  ///< from the world down

  Vec3 to_world(Vec3 p) const {
    for (auto t = frames.rbegin(); t != frames.rend(); ++t) p = to_outer(**t, p);
    return p;
  }
  Vec3 turned_to_world(Vec3 v) const {
    for (auto t = frames.rbegin(); t != frames.rend(); ++t) {
      v = to_outer(**t, v) - to_outer(**t, {0, 0, 0});
    }
    return v;
  }
};

Place random_place(Random& random, const World& world) {
  Place place{world.top, {}};
  for (;;) {
    const auto& daughters = world.volumes[place.volume].daughters;
    if (daughters.empty() || (!place.frames.empty() && chance(random, 0.2))) return place;
    const Placement& next = daughters[random() % daughters.size()];
    place.frames.push_back(&next.transformation);
    place.volume = next.volume;
  }
}

Ray awkward_ray(Random& random, const World& world) {
  const Place place = random_place(random, world);
  const Solid& solid = world.volumes[place.volume].solid;
  const Extent& e = solid.extent;
  Vec3 p{on_lattice(random, e.min.x, e.max.x), on_lattice(random, e.min.y, e.max.y),
         on_lattice(random, e.min.z, e.max.z)};
  Vec3 v = chance(random, 0.5) ? awkward_direction(random) : unit_vector(random);
  if (chance(random, 0.5)) {
    // On to the surface, and on from there in the same or another direction.
    const Direction d = kernels::make_direction(v.x, v.y, v.z);
    const auto s = solid.any();
    const double t = contains(s, p, d, world.tolerance) ? distance_to_out(s, p, d, world.tolerance)
                                                        : distance_to_in(s, p, d, world.tolerance);
    if (t < 1e30) p += t * v;
    if (chance(random, 0.5)) {
      v = chance(random, 0.5) ? awkward_direction(random) : unit_vector(random);
    }
  }
  // Along the world's axes, or the solid's own.
  if (chance(random, 0.5)) v = unit(place.turned_to_world(v));
  return {place.to_world(p), v};
}

/// A ray that starts in the world's box, or in that of a random touchable.
Ray plain_ray(Random& random, const World& world, bool deep) {
  const Vec3 v = unit(unit_vector(random));
  if (!deep) return {point_in(random, world.volumes[world.top].solid.extent), v};
  const Place place = random_place(random, world);
  return {place.to_world(point_in(random, world.volumes[place.volume].solid.extent)), v};
}

Random generator(std::uint64_t seed, std::uint64_t index) {
  std::seed_seq sequence{seed, seed >> 32, index, index >> 32};
  return Random(sequence);
}

}  // namespace

Ray make_ray(const World& world, std::uint64_t seed, std::uint64_t index) {
  Random random = generator(seed, index);
  const auto kind = random() % 10;
  return kind >= 8 ? awkward_ray(random, world) : plain_ray(random, world, kind >= 4);
}

Ray make_plain_ray(const World& world, std::uint64_t seed, std::uint64_t index) {
  Random random = generator(seed, index);
  return plain_ray(random, world, random() % 2 == 0);
}

}  // namespace navjit::campaign
