// Volumes that differ only in names share compiled code, which nevertheless knows the volume of
// each daughter.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "tests/support/traces.hpp"
#include "tests/support/volumes_apart.hpp"

namespace navjit {
namespace {

using tests::same_bits;
using tests::trace;

struct Ran {
  RuntimeReport report;
  std::size_t differ = 0;          ///< rays that are traced otherwise than generically
  std::set<VolumeId> met;          ///< volumes of these rays
  std::set<VolumeId> specialised;  ///< of these, with code of constants
};

Ran run(World world) {
  const auto shared = std::make_shared<const World>(std::move(world));
  Runtime generic(shared, tests::eager_options(JitMode::off)),
      specialised(shared, tests::eager_options(JitMode::wait));
  Navigator a = generic.navigator(), b = specialised.navigator();
  Ran ran;
  for (const Ray& ray : tests::rays_through(*shared, 11, 1500)) {
    const auto right = trace(a, ray, shared->tolerance), got = trace(b, ray, shared->tolerance);
    ran.differ += same_bits(right, got) ? 0 : 1;
    for (const tests::Row& row : got) ran.met.insert(row.volume);
  }
  ran.report = specialised.report();
  for (const SceneReport& scene : ran.report.scenes) {
    EXPECT_NE(scene.status, SceneStatus::failed) << scene.volume << ": " << scene.note;
    if (scene.binding == Binding::constants) ran.specialised.insert(scene.volume_id);
  }
  return ran;
}

/// Modules of two plates, in 24 staves about an axis.
World staves() {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 300, 300, 200));
  const VolumeId stave = tests::add_volume(world, "stave", make_box("stave", 20, 8, 90));
  const VolumeId module = tests::add_volume(world, "module", make_box("module", 15, 3, 8));
  const VolumeId plate = tests::add_volume(world, "plate", make_box("plate", 15, 1, 8));
  const VolumeId chip = tests::add_volume(world, "chip", make_box("chip", 5, 0.2, 4));
  tests::place(world, plate, chip, {3, 0.5, 0});
  for (const double y : {-1.5, 1.0}) tests::place(world, module, plate, {0, y, 0});
  for (int i = 0; i < 9; ++i) tests::place(world, stave, module, {0, i % 2 - 0.5, 18.0 * (i - 4)});
  for (int i = 0; i < 24; ++i) {
    const double at = 2 * M_PI / 24 * i;
    tests::place(world, world.top, stave, {200 * std::cos(at), 200 * std::sin(at), 0},
                 {0, 0, -at - M_PI / 2});
  }
  finish(world);
  return world;
}

TEST(EqualVolumes, AreNavigatedAlikeAndKnownByTheirNames) {
  for (const World& world : {staves(), tests::mixed_world()}) {
    const Ran ran = run(tests::volumes_apart(world));
    EXPECT_EQ(ran.differ, 0U);
    EXPECT_GT(ran.met.size(), 100U);
    EXPECT_TRUE(std::includes(ran.specialised.begin(), ran.specialised.end(), ran.met.begin(),
                              ran.met.end()));
  }
}

TEST(EqualVolumes, TakeNoMoreCodeThanOneVolume) {
  const Ran one = run(staves()), each = run(tests::volumes_apart(staves()));
  EXPECT_LT(one.report.scenes.size() * 20, each.report.scenes.size());
  EXPECT_EQ(each.report.modules, one.report.modules);
  EXPECT_LT(each.report.code_bytes, 1.5 * static_cast<double>(one.report.code_bytes));
}

TEST(EqualVolumes, MayHaveSomeOfTheirDaughtersInCommon) {
  // Plates of their own in which the chips are one volume, and the other way round.
  const World world = staves();
  for (const VolumeId stays : {4U, 3U, 2U}) {
    const Ran ran = run(tests::volumes_apart(world, {stays}));
    EXPECT_EQ(ran.differ, 0U) << stays;
    EXPECT_TRUE(std::includes(ran.specialised.begin(), ran.specialised.end(), ran.met.begin(),
                              ran.met.end()));
  }
}

TEST(EqualVolumes, AreVerifiedEach) {
  FaultyOptions options;
  static_cast<RuntimeOptions&>(options) = tests::eager_options(JitMode::wait);
  std::size_t edits = 0;
  // As if the code took every daughter for the first of its equals.
  options.faults = tests::edited([&](std::string& source) {
    const std::string right = "stand_ins = true", wrong = "stand_ins = false";
    for (std::size_t at = 0; (at = source.find(right, at)) != std::string::npos; ++edits) {
      source.replace(at, right.size(), wrong);
    }
  });
  const auto shared = std::make_shared<const World>(tests::volumes_apart(staves()));
  FaultyRuntime runtime(shared, options);
  const std::vector<Ray> rays = tests::rays_through(*shared, 11, 500);
  EXPECT_EQ(tests::traces_that_differ(runtime, rays), 0U);
  EXPECT_GT(edits, 0U);
  std::size_t failed = 0, as_others = 0;
  for (const SceneReport& scene : runtime.report().scenes) {
    failed += scene.status == SceneStatus::failed ? 1 : 0;
    as_others += scene.note == "its code was wrong for a volume that shares it" ? 1 : 0;
  }
  EXPECT_GT(failed, 100U);
  // It is said of a few what is wrong, and not of each.
  EXPECT_GT(as_others, failed - 10);
}

}  // namespace
}  // namespace navjit
