#include "analysis/facts.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace navjit
