#include "analysis/equal_scenes.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

TEST(EqualScenes, NeedTheSameSolidDaughtersAndMother) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("w", 100, 100, 100));
  const VolumeId gap = tests::add_volume(world, "gap", make_box("g", 1, 5, 5));
  std::vector<VolumeId> layers;
  for (int i = 0; i < 4; ++i) {
    // Solids of their own, the same by value but for the last.
    const VolumeId layer = tests::add_volume(world, "layer" + std::to_string(i),
                                             make_box("l", i == 3 ? 2.5 : 2, 5, 5));
    tests::place(world, layer, gap, {i == 2 ? 0.5 : 1.0, 0, 0});
    tests::place(world, world.top, layer, {-40.0 + 20 * i, 0, 0});
    layers.push_back(layer);
  }
  finish(world);
  const Geometry geometry(std::make_shared<const World>(std::move(world)));
  const WorldFacts facts = analyse_world(geometry);
  EXPECT_EQ(facts.first_equal[layers[1]], layers[0]);
  EXPECT_EQ(facts.first_equal[layers[2]], layers[2]);  // the daughter is elsewhere
  EXPECT_EQ(facts.first_equal[layers[3]], layers[3]);  // the solid is larger
  EXPECT_EQ(facts.equals[layers[0]], (std::vector<VolumeId>{layers[0], layers[1]}));
  // One navigator for both cannot have either's place built in.
  EXPECT_FALSE(facts.frames[layers[0]].only_translation.has_value());
  EXPECT_TRUE(facts.frames[layers[3]].only_translation.has_value());
}

}  // namespace
}  // namespace navjit
