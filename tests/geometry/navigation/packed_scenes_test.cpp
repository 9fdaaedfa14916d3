// What the generic navigator reads agrees with the scenes, and lies in whole cache lines.
#include "geometry/navigation/packed_scenes.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <random>
#include <set>

#include "geometry/navigation/geometry.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

std::uintptr_t address(const void* p) { return reinterpret_cast<std::uintptr_t>(p); }

/// Compares solids by their answers, since the shapes are copies.
void expect_same_solid(const kernels::AnySolid<double>& a, const kernels::AnySolid<double>& b,
                       std::mt19937_64& random) {
  ASSERT_EQ(a.kind, b.kind);
  for (int i = 0; i < 20; ++i) {
    const Vec3 p = 30 * tests::random_direction(random);
    const Vec3 u = tests::random_direction(random);
    const Direction v = kernels::make_direction(u.x, u.y, u.z);
    EXPECT_EQ(distance_to_in(a, p, v, 1e-9), distance_to_in(b, p, v, 1e-9));
    EXPECT_EQ(safety_to_in(a, p), safety_to_in(b, p));
  }
}

TEST(PackedScenes, SayWhatTheScenesSay) {
  std::mt19937_64 random(5);
  World world = tests::mixed_world();
  finish(world);
  const Geometry geometry{std::make_shared<const World>(std::move(world))};
  std::size_t rotated = 0;
  for (VolumeId volume = 0; volume < geometry.size(); ++volume) {
    const Scene& scene = geometry.scene(volume);
    const PackedScene& packed = geometry.packed(volume);
    expect_same_solid(scene.solid, packed.solid, random);
    EXPECT_EQ(packed.search, scene.search);
    EXPECT_EQ(packed.boxes, scene.boxes.get());
    EXPECT_EQ(packed.lists != nullptr, !scene.neighbour_lists.of.empty());
    ASSERT_EQ(packed.count, scene.daughters.size());
    for (std::size_t k = 0; k < packed.count; ++k) {
      const Daughter& d = scene.daughters[k];
      const PackedDaughter& p = packed.daughters[k];
      expect_same_solid(d.solid, p.solid, random);
      EXPECT_EQ(p.offset, d.offset);
      EXPECT_EQ(p.volume, d.volume);
      EXPECT_EQ(std::memcmp(p.translation, d.transformation.translation, sizeof p.translation), 0);
      ASSERT_EQ(p.rotation != nullptr, d.transformation.rotated);
      if (p.rotation == nullptr) continue;
      ++rotated;
      EXPECT_EQ(std::memcmp(p.rotation, d.transformation.rotation, 9 * sizeof(double)), 0);
    }
  }
  EXPECT_GT(rotated, 0U);
}

TEST(PackedScenes, ShareEqualShapesAndCrossNoLine) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 500, 500, 500));
  // A hundred volumes of two sizes, in three rotations.
  for (int i = 0; i < 100; ++i) {
    const Solid box = make_box("box", i % 2 == 0 ? 1 : 2, 1, 1);
    const VolumeId volume = tests::add_volume(world, "v" + std::to_string(i), box);
    tests::place(world, world.top, volume, {4.0 * i - 200, 0, 0}, {0.1 * (i % 3 + 1), 0, 0});
  }
  finish(world);
  const Geometry geometry{std::make_shared<const World>(std::move(world))};
  std::set<const void*> shapes, rotations;
  const PackedScene& top = geometry.packed(geometry.world().top);
  for (std::size_t k = 0; k < top.count; ++k) {
    const PackedDaughter& d = top.daughters[k];
    EXPECT_EQ(address(&d) % cache_line, 0U);
    EXPECT_EQ(d.solid.shape, geometry.packed(d.volume).solid.shape);
    EXPECT_LE(address(d.solid.shape) % cache_line + sizeof(kernels::Box<double>), cache_line);
    shapes.insert(d.solid.shape);
    rotations.insert(d.rotation);
  }
  EXPECT_EQ(shapes.size(), 2U);
  EXPECT_EQ(rotations.size(), 3U);
}

}  // namespace
}  // namespace navjit
