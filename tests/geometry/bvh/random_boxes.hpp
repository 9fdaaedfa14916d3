// Boxes, points and directions for the tests of bounding-volume hierarchies.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "geometry/solids/solid.hpp"

namespace navjit::bvh::test {

using Generator = std::mt19937_64;

/// A number in [low, high), the same on every platform, unlike the standard distributions.
inline double uniform(Generator& generator, double low, double high) {
  return low + (high - low) * static_cast<double>(generator() >> 11) * 0x1p-53;
}
inline std::size_t pick(Generator& generator, std::size_t count) { return generator() % count; }

inline Vec3 point(Generator& generator, double half_size) {
  return {uniform(generator, -half_size, half_size), uniform(generator, -half_size, half_size),
          uniform(generator, -half_size, half_size)};
}

/// `count` boxes in a cube of half length `half_size`; their edges are up to `edge`, some are flat.
inline std::vector<Extent> boxes(Generator& generator, std::size_t count, double half_size,
                                 double edge) {
  std::vector<Extent> result;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 low = point(generator, half_size);
    double size[3];
    for (double& s : size) s = pick(generator, 20) == 0 ? 0 : uniform(generator, 0, edge);
    result.push_back({low, {low.x + size[0], low.y + size[1], low.z + size[2]}});
  }
  return result;
}

/// n^3 touching cubes around the origin.
inline std::vector<Extent> grid(int n, double edge) {
  std::vector<Extent> result;
  for (int i = 0; i < n * n * n; ++i) {
    const int x = i % n - n / 2, y = i / n % n - n / 2, z = i / n / n - n / 2;
    const Vec3 low{x * edge, y * edge, z * edge};
    result.push_back({low, {low.x + edge, low.y + edge, low.z + edge}});
  }
  return result;
}

inline Direction normalised(double x, double y, double z) {
  const double length = std::sqrt(x * x + y * y + z * z);
  return kernels::make_direction(x / length, y / length, z / length);
}

/// A direction: isotropic, or with components that are zero, subnormal or tiny.
inline Direction direction(Generator& generator) {
  Vec3 v;
  do v = point(generator, 1);
  while (v.x * v.x + v.y * v.y + v.z * v.z < 1e-4);
  constexpr double small[] = {0, 0, 0, 1e-310, -1e-310, 1e-40, -1e-30, 1e-17, -1e-9, 1e-6};
  switch (pick(generator, 4)) {
    case 0:
      v.x = small[pick(generator, 10)];
      v.z = v.z < 0 ? v.z - 1 : v.z + 1;
      break;
    case 1:
      v.x = small[pick(generator, 10)];
      v.y = small[pick(generator, 10)];
      v.z = v.z < 0 ? -1 : 1;
      switch (pick(generator, 3)) {
        case 0:
          return normalised(v.x, v.y, v.z);
        case 1:
          return normalised(v.y, v.z, v.x);
        default:
          return normalised(v.z, v.x, v.y);
      }
    default:
      break;
  }
  return normalised(v.x, v.y, v.z);
}

}  // namespace navjit::bvh::test
