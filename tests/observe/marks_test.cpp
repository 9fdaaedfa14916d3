// What a file and a user declare as observed.
#include "observe/marks.hpp"

#include <gtest/gtest.h>

#include "navjit/errors.hpp"
#include "tests/observe/worlds.hpp"

namespace navjit {
namespace {

using tests::materials_only;
using tests::Shell;

/// A shell in the hall, with a tag.
struct Tagged : Shell {
  explicit Tagged(const std::vector<Auxiliary>& of_shell, const std::vector<Auxiliary>& of_hall) {
    builder.place(shell, hall);
    for (const Auxiliary& tag : of_shell) builder.add_auxiliary(shell, tag);
    for (const Auxiliary& tag : of_hall) builder.add_auxiliary(hall, tag);
  }
};

using Tags = std::vector<Auxiliary>;

std::uint64_t dissolved(const Tags& of_shell, const Tags& of_hall = {}) {
  return Tagged(of_shell, of_hall).observed().report().dissolved;
}

TEST(Marks, SensitiveVolumesAndRegionsCount) {
  EXPECT_EQ(dissolved({}), 1U);
  EXPECT_EQ(dissolved({{"SensDet", "tracker"}}), 0U);
  EXPECT_EQ(dissolved({}, {{"SensDet", "tracker"}}), 0U);
  EXPECT_EQ(dissolved({{"Region", "calorimeter"}}), 0U);
  // What is in a region is in it to its last daughter.
  EXPECT_EQ(dissolved({}, {{"Region", "calorimeter"}}), 1U);
}

TEST(Marks, TagsCountWhereTheyDiffer) {
  const Auxiliary cut{"gammaECut", "1e-3"}, other{"gammaECut", "1e-4"};
  EXPECT_EQ(dissolved({cut}), 0U);
  EXPECT_EQ(dissolved({cut}, {cut}), 1U);
  EXPECT_EQ(dissolved({cut}, {other}), 0U);
  EXPECT_EQ(dissolved({{"StepLimit", "1"}}), 0U);
  EXPECT_EQ(dissolved({{"Color", "red"}}), 1U);
  // No text can be taken for another's: lengths are told.
  EXPECT_EQ(dissolved({{"a", "b1:c"}}, {{"a", "b"}, {"c", ""}}), 0U);
}

TEST(Marks, RegionsOfTheWholeFileNameTheirVolumes) {
  Tagged shell({}, {});
  World world = *shell.builder.build(shell.hall).model();
  world.auxiliaries = std::make_shared<const std::vector<Auxiliary>>(
      std::vector<Auxiliary>{{"Region", "calorimeter", "", {{"volume", "shell0x7f12"}}}});
  const Marks marks = find_marks(world, materials_only);
  EXPECT_TRUE(marks.heads[shell.shell]);
  EXPECT_FALSE(invisible(marks, shell.shell, shell.hall));
  // The brick inherits it.
  EXPECT_NE(marks.classes[shell.shell], marks.classes[shell.hall]);
  EXPECT_FALSE(marks.ambiguous[shell.brick]);
}

TEST(Marks, AVolumeOfTwoRegionsHasBoundariesEverywhere) {
  Tagged shell({{"Region", "calorimeter"}}, {});
  shell.builder.place(shell.brick, shell.hall, placed_at({50, 0, 0}));
  const ObservedDetector seen = shell.observed();
  EXPECT_TRUE(seen.counts(shell.brick, shell.brick));
  EXPECT_FALSE(seen.counts(shell.hall, shell.hall));
}

TEST(Observation, IsReadAndWritten) {
  for (const char* text :
       {"all", "materials", "materials,cell", "materials,cell,a b", "budget:0.01",
        "budget:1e-06,cell", "budget:1%", "budget:0.5g/cm2", "mixtures:1%", "mixtures:0.01,cell",
        "mixtures:1%:from=0/0/-12.5", "mixtures:3g/cm2:from=0/0/0:eta=2/4.5,cell"}) {
    EXPECT_EQ(observation_text(parse_observation(text)), text);
  }
  EXPECT_EQ(parse_observation("materials,cell,a b").volumes.size(), 2U);
  EXPECT_EQ(observation_text(parse_observation("mixtures:1%:eta=2/5")),
            "mixtures:1%:from=0/0/0:eta=2/5");
  for (const char* text : {"",
                           "al",
                           "all,cell",
                           "materials,",
                           "materials,,a",
                           "material",
                           "budget",
                           "budget:",
                           "budget:0",
                           "budget:-1",
                           "budget:nan",
                           "budget:inf",
                           "budget:1x",
                           "budget:%",
                           "budget:1%%",
                           "mixtures",
                           "mixtures:",
                           "mixtures:0%",
                           "mixtures:1%:",
                           "mixtures:1%:from=1/2",
                           "mixtures:1%:from=1/2/3/4",
                           "mixtures:1%:eta=a/b",
                           "mixtures:1%:rays=aimed"}) {
    EXPECT_THROW(parse_observation(text), UsageError) << text;
  }
}

}  // namespace
}  // namespace navjit
