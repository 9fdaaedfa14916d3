#include "tests/campaign/starts.hpp"

#include <cmath>
#include <vector>

#include "geometry/model/random.hpp"
#include "geometry/solids/normal.hpp"
#include "navjit/vector.hpp"

namespace navjit::campaign {
namespace {

using Random = std::mt19937_64;

bool chance(Random& random, double p) { return uniform(random, 0, 1) < p; }

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

double of_scale(Random& random, double low, double high) {
  return std::exp(uniform(random, std::log(low), std::log(high)));
}

/// From afar, along the surface, a little within it or beside it.
Ray tangent(Random& random, const World& world) {
  const Place place = random_place(random, world);
  const Solid& solid = world.volumes[place.volume].solid;
  const auto s = solid.any();
  Vec3 p = point_in(random, solid.extent);
  const Vec3 to = unit_vector(random);
  const Direction d = kernels::make_direction(to.x, to.y, to.z);
  const double t = contains(s, p, d, world.tolerance) ? distance_to_out(s, p, d, world.tolerance)
                                                      : distance_to_in(s, p, d, world.tolerance);
  if (t < 1e30) p += t * to;
  const Vec3 n = normal(s, p, world.tolerance);
  const Vec3 any = unit_vector(random), across = any - dot(any, n) * n;
  if (!(norm(across) > 1e-3)) return {place.to_world(p), unit(place.turned_to_world(to))};
  const Vec3 v = unit(across);
  const Extent& e = solid.extent;
  const double size = norm(e.max - e.min);
  const double off = of_scale(random, 1e-17, 1e-6) * size * (random() % 2 == 0 ? 1 : -1);
  p += off * n - (chance(random, 0.3) ? 0 : of_scale(random, 1e-3, 10) * size) * v;
  return {place.to_world(p), unit(place.turned_to_world(v))};
}

/// Near an end of the solid's box, and nearly along it.
Ray along_an_end(Random& random, const World& world) {
  const Place place = random_place(random, world);
  const Extent& e = world.volumes[place.volume].solid.extent;
  const double low[3] = {e.min.x, e.min.y, e.min.z}, high[3] = {e.max.x, e.max.y, e.max.z};
  const std::size_t axis = random() % 3;
  double p[3], v[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const double room = high[i] - low[i];
    p[i] = uniform(random, low[i] - 0.5 * room, high[i] + 0.5 * room);
    v[i] = uniform(random, -1, 1);
  }
  const double steps = static_cast<double>(random() % 17) - 8;
  p[axis] = (random() % 2 == 0 ? low[axis] : high[axis]) + steps * world.tolerance / 4;
  v[axis] = chance(random, 0.2) ? 0 : of_scale(random, 1e-18, 1e-8) * (random() % 2 == 0 ? 1 : -1);
  return {place.to_world({p[0], p[1], p[2]}),
          unit(place.turned_to_world(unit({v[0], v[1], v[2]})))};
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

Ray make_grazing_ray(const World& world, std::uint64_t seed, std::uint64_t index) {
  if (index % 8 != 7) return make_ray(world, seed, index);
  Random random = generator(seed, index);
  return random() % 2 == 0 ? tangent(random, world) : along_an_end(random, world);
}

Ray make_plain_ray(const World& world, std::uint64_t seed, std::uint64_t index) {
  Random random = generator(seed, index);
  return plain_ray(random, world, random() % 2 == 0);
}

}  // namespace navjit::campaign
