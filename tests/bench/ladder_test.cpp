// The ladder of promises: rungs that know more make the same steps.
#include "bench/ladder.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "common/rays.hpp"
#include "geometry/gdml/read_world.hpp"

namespace navjit {
namespace {

using bench::Ladder;
using bench::Rung;

class LadderOf : public ::testing::TestWithParam<const char*> {};

TEST_P(LadderOf, HasTheSameStepsOnEveryRung) {
  const auto world = std::make_shared<const World>(
      read_world(std::string(NAVJIT_DETECTORS_DIR "/") + GetParam() + ".gdml"));
  common::RaySource source;
  source.aim = "auto";
  const common::RayMaker maker(*world, source);
  std::vector<Ray> rays;
  for (std::uint64_t i = 0; i < 200; ++i) rays.push_back(maker.ray(i));
  const Geometry geometry(world);
  const Ladder ladder(geometry, rays);
  ASSERT_GT(ladder.steps(), 200U);

  const Ladder::Sums right = ladder.run(Rung::search);
  EXPECT_GT(right.touchables, 0U);
  for (const Rung rung : {Rung::frames, Rung::nearest, Rung::containment}) {
    const Ladder::Sums sums = ladder.run(rung);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(sums.length), std::bit_cast<std::uint64_t>(right.length))
        << bench::name_of(rung);
    EXPECT_EQ(sums.touchables, right.touchables) << bench::name_of(rung);
    EXPECT_EQ(sums.checks > 0, rung == Rung::containment);
    // Only what ends where its daughter does is left together with it.
    EXPECT_LT(sums.denied, sums.checks / 2 + 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Bench, LadderOf, ::testing::Values("shashlik", "absorber"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace navjit
