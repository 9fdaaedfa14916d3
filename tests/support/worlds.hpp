// Worlds made in memory, for tests.
#pragma once

#include <cmath>
#include <random>

#include "geometry/model/random.hpp"
#include "geometry/model/world.hpp"
#include "navjit/vector.hpp"

namespace navjit::tests {

using navjit::uniform;

inline Vec3 random_direction(std::mt19937_64& random) {
  const Vec3 v = unit_vector(random);
  return (1 / norm(v)) * v;
}

inline VolumeId add_volume(World& world, std::string name, Solid solid) {
  LogicalVolume volume;
  volume.name = std::move(name);
  volume.solid = std::move(solid);
  world.volumes.push_back(std::move(volume));
  return static_cast<VolumeId>(world.volumes.size() - 1);
}

inline void place(World& world, VolumeId mother, VolumeId daughter, Vec3 at,
                  Vec3 angles = {0, 0, 0}) {
  Placement placement;
  placement.name =
      world.volumes[daughter].name + "_" + std::to_string(world.volumes[mother].daughters.size());
  placement.volume = daughter;
  double rotation[9];
  rotation_from_angles(angles.x, angles.y, angles.z, rotation);
  placement.transformation = make_transformation({at.x, at.y, at.z}, rotation);
  world.volumes[mother].daughters.push_back(std::move(placement));
}

/// A box of 200 mm with touching plates, a grid of tubes with cores, and rotated boxes, without
/// overlaps.
inline World mixed_world() {
  World world;
  world.top = add_volume(world, "world", make_box("world", 100, 100, 100));
  const VolumeId stack = add_volume(world, "stack", make_box("stack", 20, 20, 30));
  const VolumeId plate = add_volume(world, "plate", make_box("plate", 20, 20, 1));
  const VolumeId hole = add_volume(world, "hole", make_tube("hole", 0, 1, 1, 0, 7));
  const VolumeId tile = add_volume(world, "tile", make_box("tile", 20, 20, 2));
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) place(world, plate, hole, {-15.0 + 10 * i, -15.0 + 10 * j, 0});
  }
  for (int k = 0; k < 10; ++k) {
    place(world, stack, plate, {0, 0, -29.0 + 6 * k});
    place(world, stack, tile, {0, 0, -26.0 + 6 * k});
  }
  for (int i = 0; i < 4; ++i) place(world, world.top, stack, {-60.0 + 40 * i, -40, 0});
  const VolumeId turned = add_volume(world, "turned", make_box("turned", 8, 5, 12));
  const VolumeId core = add_volume(
      world, "core",
      make_subtraction("core", make_box("b", 2.5, 2.5, 2.5), make_tube("t", 0, 1.5, 9, 0, 7)));
  place(world, turned, core, {2, 0, 5}, {0.3, 0, 1.2});
  for (int i = 0; i < 5; ++i) {
    place(world, world.top, turned, {-70.0 + 35 * i, 30, 20}, {0.1 * i, 0.7, -0.4 * i});
    place(world, world.top, turned, {-70.0 + 35 * i, 70, -30}, {0.2 * i, -0.5, 0.9 * i});
  }
  const VolumeId ring = add_volume(world, "ring", make_tube("ring", 10, 18, 15, 0.5, 4.5));
  place(world, world.top, ring, {0, 40, -60}, {0, M_PI / 2, 0});
  place(world, world.top, ring, {-50, 40, 70});
  finish(world);
  return world;
}

/// Random boxes and tubes in a grid of cells, so that they cannot overlap; `side`^3 of them, each
/// with one more inside, at random angles.
inline World random_world(std::uint64_t seed, int side) {
  std::mt19937_64 random(seed);
  World world;
  const double half = 10.0 * side;
  world.top = add_volume(world, "world", make_box("world", half, half, half));
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      for (int k = 0; k < side; ++k) {
        const std::string name = std::to_string((i * side + j) * side + k);
        const double a = uniform(random, 1, 5), b = uniform(random, 1, 5),
                     c = uniform(random, 1, 5);
        const bool box = random() % 2 == 0;
        const VolumeId outer =
            add_volume(world, "outer" + name,
                       box ? make_box("o" + name, a, b, c)
                           : make_tube("o" + name, random() % 2 == 0 ? 0 : a / 3, a, c,
                                       uniform(random, -3, 3), uniform(random, 0.5, 7)));
        if (box) {
          const VolumeId inner = add_volume(
              world, "inner" + name, make_tube("i" + name, 0, std::min(a, b) / 2, c / 2, 0, 7));
          place(world, outer, inner, {0, 0, c / 4});
        }
        const auto angle = [&] { return uniform(random, -3, 3); };
        place(world, world.top, outer,
              {-half + 10 + 20 * i, -half + 10 + 20 * j, -half + 10 + 20 * k},
              {angle(), angle(), angle()});
      }
    }
  }
  finish(world);
  return world;
}

}  // namespace navjit::tests
