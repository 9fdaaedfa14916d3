// Rays that are made up, and what they are aimed at.
#include "common/rays.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "navjit/errors.hpp"
#include "navjit/runtime.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/worlds.hpp"

namespace navjit::common {
namespace {

bool same(const Ray& a, const Ray& b) {
  return a.position.x == b.position.x && a.position.y == b.position.y &&
         a.position.z == b.position.z && a.direction.x == b.direction.x &&
         a.direction.y == b.direction.y && a.direction.z == b.direction.z;
}

TEST(RayMaker, ARayDependsOnSeedAndNumberAlone) {
  const World world = tests::mixed_world();
  for (const char* aim : {"", "core", "auto"}) {
    const RayMaker maker(world, {.seed = 3, .aim = aim}), again(world, {.seed = 3, .aim = aim});
    const RayMaker other(world, {.seed = 4, .aim = aim});
    // Backwards, and from far beyond what anyone counts to.
    for (std::uint64_t i = 500; i-- > 0;) {
      const std::uint64_t number = i + (i % 2 == 0 ? std::uint64_t{1} << 63 : 0);
      EXPECT_TRUE(same(maker.ray(number), again.ray(number)));
      EXPECT_FALSE(same(maker.ray(number), other.ray(number)));
      EXPECT_FALSE(same(maker.ray(number), maker.ray(number + 1)));
    }
  }
}

/// How many of the rays pass through each volume, by name; all rays must start within the world.
std::map<std::string, int> met(const World& world, const RaySource& source, int rays) {
  RuntimeOptions options;
  options.jit = JitMode::off;
  Runtime runtime(world, options);
  Navigator navigator = runtime.navigator();
  const RayMaker maker(world, source);
  std::map<std::string, int> count;
  for (int i = 0; i < rays; ++i) {
    const Ray ray = maker.ray(static_cast<std::uint64_t>(i));
    std::map<std::string, int> here;
    transport(navigator, ray, world.tolerance,
              [&](const State& state, double) { here[world.volumes[state.volume()].name] = 1; });
    EXPECT_FALSE(here.empty()) << "ray " << i << " starts outside";
    for (const auto& [name, one] : here) count[name] += one;
  }
  return count;
}

TEST(Aim, EveryRayCrossesABoxOfTheVolume) {
  const World world = tests::mixed_world();
  EXPECT_EQ(met(world, {.aim = "tile"}, 400)["tile"], 400);
  // The tilted boxes, one within another: their frames are taken along.
  EXPECT_EQ(met(world, {.aim = "turned"}, 400)["turned"], 400);
  // Half as many of those that go anywhere.
  EXPECT_LT(met(world, {}, 400)["turned"], 100);
}

TEST(Aim, AllTouchablesAreEquallyLikely) {
  const World world = tests::mixed_world();
  const Target holes(world, "hole");
  ASSERT_EQ(holes.boxes(), 4U * 10 * 16);
  std::map<int, int> by_stack;
  RuntimeOptions options;
  options.jit = JitMode::off;
  Runtime runtime(world, options);
  for (std::uint64_t box = 0; box < holes.boxes(); ++box) {
    const Vec3 middle = holes.point(box, 0.5, 0.5, 0.5);
    ++by_stack[static_cast<int>(std::lround(middle.x / 20))];
    const State state = runtime.navigator().locate(middle);
    EXPECT_EQ(world.volumes[state.volume()].name, "hole");
  }
  EXPECT_GE(by_stack.size(), 4U);
  EXPECT_EQ(Target(world, "world").boxes(), 1U);
}

/// A hall of 20 m with a detector of 200 mm in it, and a wall.
World hall() {
  World world;
  world.top = tests::add_volume(world, "hall", make_box("hall", 10000, 10000, 10000));
  const VolumeId wall = tests::add_volume(world, "wall", make_box("wall", 10000, 10000, 100));
  const VolumeId envelope = tests::add_volume(world, "envelope", make_box("e", 2000, 2000, 2000));
  const VolumeId cell = tests::add_volume(world, "cell", make_box("cell", 10, 10, 10));
  tests::place(world, world.top, wall, {0, 0, -9000});
  tests::place(world, world.top, envelope, {3000, 0, 4000}, {0.4, 0.1, -0.7});
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) {
      for (int k = 0; k < 5; ++k) {
        tests::place(world, envelope, cell, {-80.0 + 40 * i, -80.0 + 40 * j, -80.0 + 40 * k});
      }
    }
  }
  finish(world);
  return world;
}

TEST(Aim, AutoIsTheBoxWithMostTouchables) {
  const World world = hall();
  const Target target(world, "auto");
  EXPECT_EQ(target.boxes(), 1U);
  const Target cells(world, "cell");
  // Its corners are those of the outermost cells.
  const auto near = [](const Vec3& a, const Vec3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) < 1e-9;
  };
  EXPECT_TRUE(near(target.point(0, 0, 0, 0), cells.point(0, 0, 0, 0)));
  EXPECT_TRUE(near(target.point(0, 1, 1, 1), cells.point(cells.boxes() - 1, 1, 1, 1)));
  const auto aimed = met(world, {.aim = "auto"}, 300);
  EXPECT_EQ(aimed.at("envelope"), 300);
  EXPECT_GT(aimed.at("cell"), 60);
  const auto anywhere = met(world, {}, 300);
  EXPECT_FALSE(anywhere.contains("cell")) << "the hall is empty for other rays";
}

TEST(Aim, AutoInAWorldWithNothingInItIsTheWorld) {
  World world;
  world.top = tests::add_volume(world, "w", make_tube("w", 5, 10, 10, 0, 7));
  finish(world);
  EXPECT_EQ(met(world, {.aim = "auto"}, 200).at("w"), 200) << "points in the hole are drawn again";
}

TEST(Aim, WhatIsNotThereIsRefused) {
  World world = tests::mixed_world();
  tests::add_volume(world, "unused", make_box("u", 1, 1, 1));
  for (const char* name : {"nobody", "unused"}) {
    try {
      [[maybe_unused]] const RayMaker rays(world, {.aim = name});
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(std::string("'") + name + "'"), std::string::npos);
    }
  }
}

TEST(RayFile, ReadsWhatSpreadsheetsWrite) {
  const tests::TemporaryFolder folder;
  const std::string path = folder.file("rays.csv");
  const auto read = [&](const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
    return read_rays(path);
  };
  const auto rays = read("\xef\xbb\xbfx, y, z, dx, dy, dz\r\n 1, +2 ,\t-3,0, 0, +5\r\n");
  ASSERT_EQ(rays.size(), 1U);
  EXPECT_TRUE(same(rays[0], {{1, 2, -3}, {0, 0, 1}}));
  for (const char* wrong : {"+-2", "++2", "1 2", "", "-+2", "0x1", "nan"}) {
    EXPECT_THROW(read(std::string("x,y,z,dx,dy,dz\n") + wrong + ",0,0,0,0,1\n"), Error) << wrong;
  }
  EXPECT_THROW(read("1,2,3,0,0,1\n"), Error) << "no header";
}

}  // namespace
}  // namespace navjit::common
