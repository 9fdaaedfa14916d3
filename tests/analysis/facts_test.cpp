#include "analysis/facts.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "geometry/navigation/generic.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

Geometry mixed() { return Geometry(std::make_shared<const World>(tests::mixed_world())); }

TEST(WorldFacts, CountTouchablesMothersAndFramesAsTheTreeHasThem) {
  const Geometry geometry = mixed();
  const WorldFacts facts = analyse_world(geometry);
  // Brute force: every touchable of the tree.
  std::vector<TouchableId> count(geometry.size(), 0);
  std::vector<std::set<VolumeId>> mothers(geometry.size());
  std::vector<std::set<std::vector<double>>> frames(geometry.size());
  std::vector<bool> rotated(geometry.size(), false);
  const auto stack = std::make_unique<NavigationStack>();
  stack->depth = -1;
  const TouchableId all = geometry.world().volumes[geometry.world().top].touchables;
  for (TouchableId t = 0; t < all; ++t) {
    generic::restore(geometry, *stack, t);
    const kernels::StackLevel& level = stack->levels[stack->depth];
    ++count[level.volume];
    if (stack->depth > 0) mothers[level.volume].insert(stack->levels[stack->depth - 1].volume);
    rotated[level.volume] = rotated[level.volume] || level.rotation != nullptr;
    frames[level.volume].insert({level.translation[0], level.translation[1], level.translation[2]});
  }
  for (VolumeId v = 0; v < geometry.size(); ++v) {
    EXPECT_EQ(facts.touchables[v], count[v]) << v;
    EXPECT_EQ(facts.reachable[v] != 0, count[v] > 0);
    EXPECT_EQ(facts.only_mothers[v].has_value(), mothers[v].size() == 1) << v;
    if (mothers[v].size() == 1) {
      EXPECT_EQ(*facts.only_mothers[v], *mothers[v].begin());
    }
    EXPECT_EQ(facts.frames[v].never_rotated, !rotated[v]) << v;
    if (facts.frames[v].only_translation) {
      ASSERT_EQ(frames[v].size(), 1U);
      const auto& t = *facts.frames[v].only_translation;
      EXPECT_EQ(*frames[v].begin(), (std::vector<double>{t[0], t[1], t[2]}));
    }
  }
}

/// The same volume on a way where turns cancel out and on one where nothing turns.
TEST(WorldFacts, TurnsThatCancelOutBesideNone) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 60, 40, 30));
  const VolumeId turned = tests::add_volume(world, "turned", make_box("turned", 20, 20, 20));
  const VolumeId plain = tests::add_volume(world, "plain", make_box("plain", 20, 20, 20));
  const VolumeId leaf = tests::add_volume(world, "leaf", make_box("leaf", 5, 5, 5));
  tests::place(world, world.top, turned, {-30, 0, 0}, {0, 0, M_PI});
  tests::place(world, turned, leaf, {0, 0, 0}, {0, 0, -M_PI});
  tests::place(world, world.top, plain, {30, 0, 0});
  tests::place(world, plain, leaf, {0, 0, 0});
  finish(world);
  const Geometry geometry(std::make_shared<const World>(std::move(world)));
  const WorldFacts facts = analyse_world(geometry);
  EXPECT_FALSE(facts.frames[leaf].never_rotated);
  EXPECT_FALSE(facts.frames[leaf].only_rotation.has_value());
}

/// Levels below a rotated one have a rotation, also if it is the identity again.
TEST(WorldFacts, TurnsThatCancelOutAreTurns) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 40, 40, 30));
  const VolumeId outer = tests::add_volume(world, "outer", make_box("outer", 20, 20, 20));
  const VolumeId inner = tests::add_volume(world, "inner", make_box("inner", 5, 5, 5));
  const VolumeId beside = tests::add_volume(world, "beside", make_box("beside", 5, 5, 5));
  tests::place(world, world.top, outer, {0, 0, 0}, {0, 0, M_PI});
  tests::place(world, outer, inner, {0, 0, 0}, {0, 0, -M_PI});
  tests::place(world, world.top, beside, {30, 0, 0});
  finish(world);
  const Geometry geometry(std::make_shared<const World>(std::move(world)));
  const WorldFacts facts = analyse_world(geometry);
  EXPECT_FALSE(facts.frames[inner].never_rotated);
  EXPECT_TRUE(facts.frames[beside].never_rotated);
  constexpr std::array<double, 9> identity{1, 0, 0, 0, 1, 0, 0, 0, 1};
  ASSERT_TRUE(facts.frames[inner].only_rotation.has_value());
  EXPECT_EQ(*facts.frames[inner].only_rotation, identity);
}

}  // namespace
}  // namespace navjit
