#include "geometry/model/world.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace navjit {
namespace {

/// Adds a volume with these daughters; each placement gets its volume's name with a number.
VolumeId add(World& world, const std::string& name, std::initializer_list<VolumeId> daughters) {
  LogicalVolume volume;
  volume.name = name;
  volume.solid = make_box(name, 100, 200, 300);
  for (const VolumeId id : daughters) {
    Placement placement;
    const std::string base = id < world.volumes.size() ? world.volumes[id].name : "none";
    placement.name = base + std::to_string(volume.daughters.size());
    placement.volume = id;
    volume.daughters.push_back(placement);
  }
  world.volumes.push_back(volume);
  return world.top = static_cast<VolumeId>(world.volumes.size() - 1);
}

std::string finish_error(World& world) {
  try {
    finish(world);
  } catch (const GeometryError& e) {
    return e.what();
  }
  ADD_FAILURE() << "the world is accepted";
  return {};
}

TEST(World, NumbersTouchablesInPreorder) {
  World world;
  const VolumeId leaf = add(world, "leaf", {});
  const VolumeId pair = add(world, "pair", {leaf, leaf});
  const VolumeId top = add(world, "top", {leaf, pair, leaf, pair});
  finish(world);
  EXPECT_EQ(world.volumes[leaf].touchables, 1u);
  EXPECT_EQ(world.volumes[pair].touchables, 3u);
  EXPECT_EQ(world.volumes[top].touchables, 9u);
  const auto& d = world.volumes[top].daughters;
  EXPECT_EQ(d[0].offset, 1u);
  EXPECT_EQ(d[1].offset, 2u);
  EXPECT_EQ(d[2].offset, 5u);
  EXPECT_EQ(d[3].offset, 6u);
  EXPECT_EQ(world.depth, 3);
  const char* paths[] = {
      "top",       "top/leaf0", "top/pair1",       "top/pair1/leaf0", "top/pair1/leaf1",
      "top/leaf2", "top/pair3", "top/pair3/leaf0", "top/pair3/leaf1"};
  for (TouchableId id = 0; id < 9; ++id) EXPECT_EQ(path_of(world, id), paths[id]);
  EXPECT_THROW(path_of(world, 9), UsageError);
}

TEST(World, ALoneVolumeHasOneLevel) {
  World world;
  add(world, "alone", {});
  finish(world);
  EXPECT_EQ(world.depth, 1);
  EXPECT_EQ(path_of(world, 0), "alone");
}

TEST(World, SetsTheToleranceFromItsSize) {
  World world;
  add(world, "top", {});
  finish(world);
  EXPECT_EQ(world.tolerance, 1e-11);
  world.tolerance_rule = {1e-12, 1e-10};
  finish(world);
  EXPECT_DOUBLE_EQ(world.tolerance, 3e-8);
}

TEST(World, MayBeFinishedAgain) {
  World world;
  const VolumeId leaf = add(world, "leaf", {});
  add(world, "top", {leaf, leaf});
  finish(world);
  finish(world);
  EXPECT_EQ(world.volumes[world.top].touchables, 3u);
  EXPECT_EQ(world.volumes[world.top].daughters[1].offset, 2u);
}

TEST(World, NamesTheVolumesOfACycle) {
  World world;
  add(world, "a", {1});
  add(world, "b", {2});
  add(world, "c", {0});
  add(world, "top", {0});
  EXPECT_EQ(finish_error(world), "volumes contain one another: a -> b -> c -> a");
  World self;
  add(self, "self", {0});
  EXPECT_EQ(finish_error(self), "volumes contain one another: self -> self");
}

TEST(World, KeepsVolumesThatNobodyPlaces) {
  World world;
  add(world, "island", {0});  // contains itself, but is not reached
  add(world, "top", {});
  finish(world);
  EXPECT_EQ(world.volumes.size(), 2u);
  EXPECT_EQ(world.volumes[world.top].touchables, 1u);
}

TEST(World, BoundsItsDepth) {
  World world;
  VolumeId inner = add(world, "v0", {});
  for (int i = 1; i < max_depth; ++i) inner = add(world, "v", {inner});
  finish(world);
  EXPECT_EQ(world.depth, max_depth);
  add(world, "one too many", {inner});
  EXPECT_NE(finish_error(world).find("65 levels deep"), std::string::npos);
  for (int i = 0; i < 200'000; ++i) inner = add(world, "v", {inner});
  EXPECT_NE(finish_error(world).find("levels deep"), std::string::npos);
}

TEST(World, BoundsItsTouchables) {
  World world;
  VolumeId inner = add(world, "v0", {});
  for (int i = 1; i < 62; ++i) inner = add(world, "v" + std::to_string(i), {inner, inner});
  finish(world);
  const TouchableId count = world.volumes[world.top].touchables;
  EXPECT_EQ(count, (TouchableId{1} << 62) - 1);
  EXPECT_EQ(path_of(world, count - 1).size(), path_of(world, 61).size());
  add(world, "v62", {inner, inner});
  EXPECT_NE(finish_error(world).find("'v62' holds more than 2^62 touchables"), std::string::npos);
}

TEST(World, RefusesVolumesThatDoNotExist) {
  World empty;
  EXPECT_NE(finish_error(empty).find("does not exist"), std::string::npos);
  World world;
  add(world, "top", {7});
  EXPECT_NE(finish_error(world).find("placement 'none0' in volume 'top'"), std::string::npos);
}

}  // namespace
}  // namespace navjit
