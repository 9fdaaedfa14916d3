#include "runtime/overrides.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "navjit/runtime.hpp"
#include "runtime/transport.hpp"
#include "tests/support/traces.hpp"
#include "tests/support/volumes_apart.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

TEST(Overrides, AreParsedAndComplainedAbout) {
  const World world = tests::mixed_world();
  const auto [o, complaints] =
      parse_overrides(world, "stack=off,plate=all,nobody=off,tile=fast,ring");
  EXPECT_EQ(o.size(), 2U);
  EXPECT_EQ(o.at(1), std::nullopt);
  EXPECT_EQ(o.at(2), Candidates::all);
  EXPECT_NE(
      complaints.find("'tile=fast': NAME=off, all, lanes, nest, rings, wires, grid, boxes, scan, "
                      "groups, tree or layers is needed"),
      std::string::npos)
      << complaints;
  for (const char* unknown : {"none", "slabs", ""}) {  // searches that are not forced, and no name
    const Overrides refused = parse_overrides(world, std::string("stack=") + unknown);
    EXPECT_TRUE(refused.searches.empty()) << unknown;
    EXPECT_NE(refused.complaints, "") << unknown;
  }
  EXPECT_EQ(std::count(complaints.begin(), complaints.end(), '\n'), 3) << complaints;
  const auto round =
      parse_overrides(world, "stack=nest,plate=lanes,plate=rings,world=wires").searches;
  EXPECT_EQ(round.at(1), Candidates::nest);
  EXPECT_EQ(round.at(2), Candidates::rings);
  EXPECT_EQ(round.at(0), Candidates::wires);
  const auto every = parse_overrides(world, "*=off,stack=grid").searches;
  EXPECT_EQ(every.size(), world.volumes.size());
  EXPECT_EQ(every.at(0), std::nullopt);
  EXPECT_EQ(every.at(1), Candidates::grid);
  EXPECT_TRUE(parse_overrides(world, "").searches.empty());
}

TEST(Overrides, FromTheEnvironmentForceScenes) {
  setenv(overrides_variable, "*=off,plate=all", 1);
  RuntimeOptions options;
  options.jit = JitMode::wait;
  Runtime runtime(tests::mixed_world(), options);
  unsetenv(overrides_variable);
  Navigator navigator = runtime.navigator();
  for (double x = -99; x < 99; x += 0.37) {
    transport(navigator, {{x, -40.3, -99}, {0, 0, 1}}, 1e-11);
    transport(navigator, {{-99, -40.3, x}, {1, 0, 0}}, 1e-11);
  }
  std::size_t specialised = 0;
  for (const SceneReport& scene : runtime.report().scenes) {
    if (scene.status == SceneStatus::specialised) {
      ++specialised;
      EXPECT_EQ(scene.volume, "plate");
    } else {
      EXPECT_EQ(scene.status, SceneStatus::unprofitable);
      EXPECT_NE(scene.note.find("NAVJIT_SCENES"), std::string::npos);
    }
  }
  EXPECT_EQ(specialised, 1U);
}

/// The plates that are specialised, and those for which it is off, where each plate is a volume of
/// its own.
struct Plates {
  std::vector<std::string> specialised, off;
};
Plates plates_with(const std::string& overrides) {
  setenv(overrides_variable, overrides.c_str(), 1);
  const auto world = std::make_shared<const World>(tests::volumes_apart(tests::mixed_world()));
  Runtime runtime(world, tests::eager_options(JitMode::wait));
  unsetenv(overrides_variable);
  Navigator navigator = runtime.navigator();
  for (const Ray& ray : tests::rays_through(*world, 21, 1000)) {
    transport(navigator, ray, world->tolerance);
  }
  Plates plates;
  for (const SceneReport& scene : runtime.report().scenes) {
    if (!scene.volume.starts_with("plate")) continue;
    const bool off = scene.note.find("off by") != std::string::npos;
    (scene.status == SceneStatus::specialised ? plates.specialised : plates.off)
        .push_back(scene.volume);
    EXPECT_EQ(scene.status == SceneStatus::specialised, !off) << scene.volume << scene.note;
  }
  return plates;
}

TEST(Overrides, SwitchOffOneOfEqualVolumes) {
  const Plates all = plates_with("");
  ASSERT_GT(all.specialised.size(), 20U);
  EXPECT_TRUE(all.off.empty());
  // The first of them, which stands for all in the code, and one of the others.
  const auto by_number = [](const std::string& a, const std::string& b) {
    return std::pair(a.size(), a) < std::pair(b.size(), b);
  };
  const auto [first, last] =
      std::minmax_element(all.specialised.begin(), all.specialised.end(), by_number);
  for (const std::string& one : {*first, *last}) {
    const Plates but_one = plates_with(one + "=off");
    EXPECT_EQ(but_one.off, std::vector{one});
    EXPECT_EQ(but_one.specialised.size(), all.specialised.size() - 1);
    const Plates only_one = plates_with("*=off," + one + "=all");
    EXPECT_EQ(only_one.specialised, std::vector{one});
    EXPECT_EQ(only_one.off.size(), all.specialised.size() - 1);
  }
}

}  // namespace
}  // namespace navjit
