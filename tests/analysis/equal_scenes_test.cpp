#include "analysis/equal_scenes.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "tests/support/volumes_apart.hpp"
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
  EXPECT_FALSE(facts.of_equals[layers[0]].stand_ins);
}

TEST(EqualScenes, MayHaveDaughtersOfOtherNames) {
  const World mixed = tests::mixed_world();
  const Geometry geometry(std::make_shared<const World>(tests::volumes_apart(mixed)));
  const WorldFacts facts = analyse_world(geometry);
  // Each of the volumes as it is, whatever it is called, but for rods in plates and such things
  // that are in many places: their mothers tell them apart no more.
  std::set<VolumeId> firsts(facts.first_equal.begin(), facts.first_equal.end());
  EXPECT_GE(firsts.size(), mixed.volumes.size());
  EXPECT_LE(firsts.size(), mixed.volumes.size() + 4);
  EXPECT_GT(geometry.size(), 5 * firsts.size());
  for (VolumeId v = 0; v < geometry.size(); ++v) {
    const Scene &own = geometry.scene(v), &first = geometry.scene(facts.first_equal[v]);
    ASSERT_EQ(own.daughters.size(), first.daughters.size());
    for (std::size_t k = 0; k < own.daughters.size(); ++k) {
      // Code of the first enters scenes that the other's daughters share, too.
      EXPECT_EQ(facts.first_equal[own.daughters[k].volume],
                facts.first_equal[first.daughters[k].volume]);
      if (own.daughters[k].volume != first.daughters[k].volume) {
        EXPECT_TRUE(facts.of_equals[facts.first_equal[v]].stand_ins);
      }
    }
    const auto mothers = facts.of_equals[facts.first_equal[v]].mothers;
    if (mothers) {
      EXPECT_EQ(facts.first_equal[*facts.only_mothers[v]], *mothers);
    }
  }
}

/// So many boxes of one size, each a volume of its own, with its own rod in it, turned differently.
WorldFacts facts_of_turned_boxes(int boxes) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("w", 1000, 100, 100));
  for (int i = 0; i < boxes; ++i) {
    const std::string n = std::to_string(i);
    const VolumeId box = tests::add_volume(world, "box" + n, make_box("b", 2, 5, 5));
    const VolumeId rod = tests::add_volume(world, "rod" + n, make_tube("r", 0, 1, 3, 0, 7));
    tests::place(world, box, rod, {0.5, 0, 0});
    tests::place(world, world.top, box, {-900.0 + 20 * i, 0, 0}, {0, 0, 0.1 * (i + 1)});
  }
  finish(world);
  return analyse_world(Geometry(std::make_shared<const World>(std::move(world))));
}

TEST(EqualScenes, AreToldApartByAFewRotations) {
  const WorldFacts facts = facts_of_turned_boxes(3);
  for (const VolumeId box : {1U, 3U, 5U}) {
    EXPECT_EQ(facts.first_equal[box], box);
    EXPECT_TRUE(facts.of_equals[box].frame.only_rotation.has_value());
    EXPECT_TRUE(facts.of_equals[box].frame.only_translation.has_value());
  }
}

TEST(EqualScenes, OfManyRotationsShareCodeForAnyFrame) {
  const WorldFacts facts = facts_of_turned_boxes(12);
  for (int i = 0; i < 12; ++i) {
    const auto box = static_cast<VolumeId>(1 + 2 * i);
    EXPECT_EQ(facts.first_equal[box], 1U);
    EXPECT_EQ(facts.first_equal[box + 1], 2U);
    // What is bound to the data of one of them knows its rotation.
    EXPECT_TRUE(facts.frames[box].only_rotation.has_value());
  }
  for (const VolumeId first : {1U, 2U}) {
    EXPECT_FALSE(facts.of_equals[first].frame.only_rotation.has_value());
    EXPECT_FALSE(facts.of_equals[first].frame.never_rotated);
    EXPECT_FALSE(facts.of_equals[first].frame.only_translation.has_value());
  }
  EXPECT_EQ(facts.of_equals[1].only_mother, 0U);
  EXPECT_EQ(facts.of_equals[1].mothers, 0U);
  EXPECT_TRUE(facts.of_equals[1].stand_ins);
  EXPECT_FALSE(facts.of_equals[2].only_mother.has_value());
  EXPECT_EQ(facts.of_equals[2].mothers, 1U);
  EXPECT_FALSE(facts.of_equals[2].stand_ins);
  // The world has daughters that its code enters all as the first one.
  EXPECT_TRUE(facts.of_equals[0].stand_ins);
}

/// Boxes that are alike, in mothers of so many different lengths.
WorldFacts facts_of_boxes_in_mothers(int lengths) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("w", 1000, 100, 100));
  for (int i = 0; i < 2 * lengths; ++i) {
    const std::string n = std::to_string(i);
    const VolumeId mother = tests::add_volume(world, "m" + n, make_box("m", 5, 8, 8 + i / 2));
    const VolumeId box = tests::add_volume(world, "b" + n, make_box("b", 2, 5, 5));
    tests::place(world, mother, box, {0.5, 0, 0});
    tests::place(world, world.top, mother, {-900.0 + 20 * i, 0, 0});
  }
  finish(world);
  return analyse_world(Geometry(std::make_shared<const World>(std::move(world))));
}

TEST(EqualScenes, AreToldApartByAFewKindsOfMothers) {
  const WorldFacts facts = facts_of_boxes_in_mothers(2);
  EXPECT_EQ(facts.first_equal[4], 2U);  // boxes in mothers of the first length
  EXPECT_EQ(facts.first_equal[6], 6U);
  EXPECT_EQ(facts.of_equals[2].mothers, 1U);
  EXPECT_EQ(facts.of_equals[6].mothers, 5U);
}

TEST(EqualScenes, OfManyKindsOfMothersShareCode) {
  const WorldFacts facts = facts_of_boxes_in_mothers(8);
  for (VolumeId box = 2; box <= 32; box += 2) EXPECT_EQ(facts.first_equal[box], 2U);
  EXPECT_FALSE(facts.of_equals[2].mothers.has_value());
  EXPECT_FALSE(facts.of_equals[2].only_mother.has_value());
  EXPECT_EQ(facts.first_equal[3], 1U);  // the second mother of the first length
  EXPECT_EQ(facts.first_equal[5], 5U);
}

}  // namespace
}  // namespace navjit
