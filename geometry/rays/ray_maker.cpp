#include "geometry/rays/ray_maker.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace navjit {
namespace {

/// splitmix64 (Steele, Lea and Flood 2014): good numbers even from consecutive seeds.
struct Generator {
  std::uint64_t state;
  double operator()() {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
};

}  // namespace

template <class Random>
Vec3 RayMaker::aimed_start(Random& random, const Vec3& direction) const {
  const Solid& world = world_.volumes[world_.top].solid;
  const Direction back = kernels::make_direction(-direction.x, -direction.y, -direction.z);
  Vec3 point{};
  // Boxes may stick out of a world that is no box. After so many tries the ray starts outside.
  for (int tries = 0; tries < 100; ++tries) {
    const auto boxes = static_cast<double>(target_->boxes());
    const double which = random() * boxes, u = random(), v = random(), w = random();
    point = target_->point(static_cast<std::uint64_t>(std::min(which, boxes - 1)), u, v, w);
    if (inside(world.any(), point, world_.tolerance) != Side::inside) continue;
    // Just inside the world, whatever rounding does.
    const double way = (1 - 0x1p-30) * distance_to_out(world.any(), point, back, world_.tolerance);
    return {point.x - way * direction.x, point.y - way * direction.y, point.z - way * direction.z};
  }
  return point;
}

RayMaker::RayMaker(const World& world, RaySource source)
    : world_(world), source_(std::move(source)) {
  if (!source_.aim.empty()) target_.emplace(world, source_.aim);
}

Ray RayMaker::ray(std::uint64_t number) const {
  Generator random{source_.seed * 0xd1342543de82ef95U + number * 0x2545f4914f6cdd1dU};
  Ray ray;
  if (source_.origin) {
    ray.position = *source_.origin;
  } else if (!target_) {
    const Extent& e = world_.volumes[world_.top].solid.extent;
    ray.position = {e.min.x + random() * (e.max.x - e.min.x),
                    e.min.y + random() * (e.max.y - e.min.y),
                    e.min.z + random() * (e.max.z - e.min.z)};
  }
  const double phi = 2 * std::numbers::pi * random();
  double cosine, sine;
  if (source_.eta) {
    const double eta = source_.eta->first + random() * (source_.eta->second - source_.eta->first);
    cosine = std::tanh(eta);
    sine = 1 / std::cosh(eta);
  } else {
    cosine = 2 * random() - 1;
    sine = std::sqrt((1 - cosine) * (1 + cosine));
  }
  const double x = sine * std::cos(phi), y = sine * std::sin(phi);
  const double length = std::hypot(x, y, cosine);
  ray.direction = {x / length, y / length, cosine / length};
  if (target_) ray.position = aimed_start(random, ray.direction);
  return ray;
}

}  // namespace navjit
