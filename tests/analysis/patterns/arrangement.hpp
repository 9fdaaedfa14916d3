// A mother with daughters in a pattern, and the check that no candidate which is met is left out.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "geometry/navigation/geometry.hpp"
#include "geometry/solids/list.hpp"
#include "navjit/vector.hpp"
#include "tests/support/worlds.hpp"

namespace navjit::tests {

constexpr double pattern_tolerance = 1e-9, infinite = INFINITY;

/// A mother with daughters.
struct Arrangement {
  World world;
  std::unique_ptr<Geometry> geometry;
  explicit Arrangement(const Solid& mother) { tests::add_volume(world, "mother", mother); }
  void add(const Solid& solid, Vec3 at = {0, 0, 0}, Vec3 angles = {0, 0, 0}) {
    const VolumeId v = tests::add_volume(world, "d" + std::to_string(world.volumes.size()), solid);
    tests::place(world, 0, v, at, angles);
  }
  void finished(std::mt19937_64& random) {
    std::shuffle(world.volumes[0].daughters.begin(), world.volumes[0].daughters.end(), random);
    finish(world);
    geometry = std::make_unique<Geometry>(std::make_shared<const World>(world));
  }
  std::span<const Daughter> daughters() const { return geometry->scene(0).daughters; }
  const Solid& mother() const { return geometry->world().volumes[0].solid; }
};

inline double distance(const Daughter& d, const Vec3& p, const Direction& v) {
  return distance_to_in(d.solid, to_local(d.transformation, p), to_local(d.transformation, v),
                        pattern_tolerance);
}

struct AskedRay {
  Vec3 position, direction;
};

/// Rays from anywhere, from surfaces, along the axis, through it, and along tangents and edges.
inline AskedRay random_ray(std::mt19937_64& random, const Arrangement& a, double half, int i) {
  Vec3 p{uniform(random, -half, half), uniform(random, -half, half), uniform(random, -half, half)};
  Vec3 d = random_direction(random);
  const Daughter& of = a.daughters()[random() % a.daughters().size()];
  if (i % 4 == 1) {  // where a ray meets a daughter
    const double t = distance(of, p, kernels::make_direction(d.x, d.y, d.z));
    if (t < infinite) p += t * d;
    if (i % 8 == 1) d = random_direction(random);
  }
  if (i % 7 == 0) d = {0, 0, i % 2 == 0 ? 1.0 : -1.0};
  if (i % 11 == 0) p = {0, 0, p.z};
  const double rho = std::hypot(p.x, p.y);
  if (i % 5 == 0 && rho > 0) {  // along a radius, in or out, or a tangent
    d = i % 10 == 0 ? Vec3{p.y / rho, -p.x / rho, 0} : Vec3{p.x / rho, p.y / rho, 0};
    if (i % 3 == 0) d = -1.0 * d;
  }
  if (i % 13 == 0) {  // from a daughter's corner
    const Extent e = a.geometry->world().volumes[of.volume].solid.extent;
    p = to_outer(of.transformation, i % 2 == 0 ? e.min : e.max);
  }
  return {p, d};
}

struct Tally {
  std::size_t asked = 0, all = 0, met = 0;
};

/// `walk` must find the same nearest daughter as all daughters together, and `at` all that hold a
/// point, for the rays that ray_of(i) gives.
template <class RayOf, class Walk, class At>
void expect_complete_for(const Arrangement& a, std::mt19937_64& random, double half, RayOf ray_of,
                         Walk walk, At at, Tally& tally) {
  const auto daughters = a.daughters();
  for (int i = 0; i < 600; ++i) {
    const AskedRay ray = ray_of(i);
    const Vec3& p = ray.position;
    const Direction v = kernels::make_direction(ray.direction.x, ray.direction.y, ray.direction.z);
    const double limit = i % 3 == 0 ? uniform(random, 0, half) : i % 3 == 1 ? 4 * half : infinite;
    double nearest = infinite, best = infinite;
    for (const Daughter& d : daughters) nearest = std::min(nearest, distance(d, p, v));
    if (nearest > limit) nearest = infinite;
    std::vector<char> offered(daughters.size(), 0);
    walk(
        p, v,
        [&](unsigned k) {
          offered[k] = 1;
          ++tally.asked;
          best = std::min(best, distance(daughters[k], p, v));
        },
        [&] { return std::min(best, limit); });
    if (best > limit) best = infinite;
    ASSERT_EQ(best, nearest) << "ray " << i << " from " << p.x << ' ' << p.y << ' ' << p.z
                             << " along " << v.x << ' ' << v.y << ' ' << v.z;
    // Of those that are equally near the first in the file has to be among what was offered.
    for (std::size_t k = 0; k < daughters.size() && best < infinite; ++k) {
      ASSERT_TRUE(offered[k] || distance(daughters[k], p, v) != nearest) << "ray " << i;
    }
    tally.all += daughters.size();
    tally.met += best < infinite ? 1 : 0;
    std::fill(offered.begin(), offered.end(), 0);
    at(p, [&](unsigned k) { offered[k] = 1; });
    for (std::size_t k = 0; k < daughters.size(); ++k) {
      const Vec3 q = to_local(daughters[k].transformation, p);
      ASSERT_TRUE(offered[k] || inside(daughters[k].solid, q, pattern_tolerance) == Side::outside);
    }
  }
}

/// The same for rays about the z axis.
template <class Walk, class At>
void expect_complete(const Arrangement& a, std::mt19937_64& random, double half, Walk walk, At at,
                     Tally& tally) {
  expect_complete_for(
      a, random, half, [&](int i) { return random_ray(random, a, half, i); }, walk, at, tally);
}

}  // namespace navjit::tests
