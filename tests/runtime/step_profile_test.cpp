// Profiles in files are read back and merged, and refused if they are not right.
#include "navjit/step_profile.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <limits>
#include <random>

#include "navjit/gdml.hpp"
#include "runtime/make_plugin.hpp"
#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/traces.hpp"

namespace navjit {
namespace {

using tests::TemporaryFolder;

bool operator==(const StepProfile& a, const StepProfile& b) {
  return a.geometry == b.geometry && a.runs == b.runs &&
         std::equal(a.volumes.begin(), a.volumes.end(), b.volumes.begin(), b.volumes.end(),
                    [](const auto& x, const auto& y) {
                      return x.volume == y.volume && x.name == y.name && x.steps == y.steps &&
                             x.relocations == y.relocations;
                    });
}

StepProfile random_profile(std::mt19937_64& random) {
  StepProfile profile;
  profile.geometry = "0123";
  profile.runs = random() % 9;
  for (VolumeId v = 0; v < 30; ++v) {
    if (random() % 2 == 0) continue;
    profile.volumes.push_back(
        {v, "v\"\\\n" + std::to_string(v), random() >> (random() % 64), random() % 1000});
  }
  return profile;
}

TEST(StepProfileTest, ReadsWhatItWritesAndMergesInAnyOrder) {
  const TemporaryFolder folder;
  std::mt19937_64 random(1);
  for (int round = 0; round < 50; ++round) {
    const StepProfile a = random_profile(random), b = random_profile(random),
                      c = random_profile(random);
    write_profile(a, folder.file("p"));
    EXPECT_TRUE(read_profile(folder.file("p")) == a);
    EXPECT_TRUE(merge(a, b) == merge(b, a));
    EXPECT_TRUE(merge(merge(a, b), c) == merge(a, merge(b, c)));
  }
  StepProfile most;
  most.volumes.push_back({1, "v", std::numeric_limits<std::uint64_t>::max(), 0});
  EXPECT_EQ(merge(most, most).volumes[0].steps, std::numeric_limits<std::uint64_t>::max());
  StepProfile other;
  other.geometry = "4567";
  EXPECT_THROW(merge(most, other), Error);
}

TEST(StepProfileTest, WhatIsNoProfileIsRefusedWithTheFilesName) {
  const TemporaryFolder folder;
  const std::string path = folder.file("profile.json");
  const std::string head =
      "{\"format\": \"navjit profile\", \"version\": 1, \"geometry\": \"0\", \"runs\": 1";
  const std::string row = "{\"volume\": 1, \"name\": \"v\", \"steps\": 1, \"relocations\": 1}";
  tests::write_file(path, head + ", \"volumes\": [" + row + "]}");
  EXPECT_EQ(read_profile(path).volumes.size(), 1U);
  const auto volumes = [&](const std::string& text) {
    return head + ", \"volumes\": " + text + "}";
  };
  for (const std::string& bad :
       {std::string(), std::string("[]"), std::string("{}"), std::string(1000000, '['), head,
        head + "}", volumes("1"), volumes("[1]"), volumes("[{}]"),
        volumes("[" + row + "," + row + "]"),
        volumes("[{\"volume\": -1, \"name\": \"v\", \"steps\": 1, \"relocations\": 1}]"),
        volumes("[{\"volume\": 4294967296, \"name\": \"v\", \"steps\": 1, \"relocations\": 1}]"),
        volumes("[{\"volume\": 1, \"name\": 7, \"steps\": 1, \"relocations\": 1}]"),
        volumes("[{\"volume\": 1, \"name\": \"v\", \"steps\": 1.5, \"relocations\": 1}]"),
        volumes("[{\"volume\": 1, \"name\": \"v\", \"steps\": 1e30, \"relocations\": 1}]"),
        std::string("{\"format\": \"navjit profile\", \"version\": 2}"),
        std::string("\x7f"
                    "ELF\0",
                    5)}) {
    tests::write_file(path, bad);
    try {
      read_profile(path);
      ADD_FAILURE() << bad.substr(0, 200);
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).rfind(path + ": ", 0), 0U) << error.what();
    }
  }
  for (const std::string& none : {folder.file("none"), folder.path(), std::string("/dev/zero")}) {
    EXPECT_THROW(read_profile(none), Error) << none;
  }
  ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
  EXPECT_THROW(read_profile(folder.file("pipe")), Error) << "and does not wait";
  EXPECT_THROW(write_profile({}, "/nowhere/profile.json"), Error);
}

TEST(StepProfileTest, MutatedProfilesAreReadOrRefused) {
  const TemporaryFolder folder;
  std::mt19937_64 random(3);
  write_profile(random_profile(random), folder.file("p"));
  const std::string right = tests::read_file(folder.file("p"));
  int refused = 0;
  for (int round = 0; round < 500; ++round) {
    std::string text = right;
    for (int n = 0; n < 1 + round % 4; ++n) {
      const std::size_t at = random() % text.size();
      if (random() % 2 == 0) {
        text[at] = static_cast<char>(random());
      } else {
        text.erase(at, random() % 50);
      }
    }
    tests::write_file(folder.file("p"), text);
    try {
      read_profile(folder.file("p"));
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 25);
}

/// A calorimeter that layers fill; tiles fill the layers.
constexpr const char* layers = R"(<gdml><define/>
<materials><material name="Lead" Z="82"><D value="11.35"/><atom value="207.2"/></material></materials>
<solids><box name="all" x="1000" y="1000" z="1000"/><box name="calorimeter" x="400" y="400" z="400"/>
<box name="layer" x="400" y="400" z="100"/><box name="tile" x="200" y="400" z="100"/></solids>
<structure>
<volume name="tile"><materialref ref="Lead"/><solidref ref="tile"/></volume>
<volume name="layer"><materialref ref="Lead"/><solidref ref="layer"/>
<physvol><volumeref ref="tile"/><position name="a" x="-100"/></physvol>
<physvol><volumeref ref="tile"/><position name="b" x="100"/></physvol></volume>
<volume name="calorimeter"><materialref ref="Lead"/><solidref ref="calorimeter"/>
<replicavol number="4"><volumeref ref="layer"/><replicate_along_axis><direction z="1"/>
<width value="100" unit="mm"/><offset value="0"/></replicate_along_axis></replicavol></volume>
<volume name="all"><materialref ref="Lead"/><solidref ref="all"/>
<physvol><volumeref ref="calorimeter"/></physvol></volume>
</structure><setup name="Default" version="1.0"><world ref="all"/></setup></gdml>)";

TEST(StepProfileTest, RelocationsAreCountedInAllVolumesThatAStepPasses) {
  const TemporaryFolder folder;
  tests::write_file(folder.file("layers.gdml"), layers);
  Runtime runtime(read_gdml(folder.file("layers.gdml")), tests::eager_options(JitMode::off));
  Navigator navigator = runtime.navigator();
  // From tile to tile, each in a layer of its own: out of the layer, through the calorimeter.
  constexpr int rays = 20000;
  for (int i = 0; i < rays; ++i) {
    const Vec3 point{-100 + 1e-3 * i, 10, -300};
    State state = navigator.locate(point, {0, 0, 1});
    for (Vec3 p = point; state.inside();) {
      const Step step = navigator.step(state, p, {0, 0, 1});
      p.z += step.length;
      state = step.next;
    }
  }
  // In, three times from layer to layer, and out.
  const StepProfile profile = runtime.step_profile();
  std::uint64_t in_layer = 0, in_calorimeter = 0;
  for (const auto& v : profile.volumes) {
    if (v.name == "layer") in_layer = v.relocations;
    if (v.name == "calorimeter") in_calorimeter = v.relocations;
    EXPECT_TRUE(v.name == "tile" || v.name == "all" || v.steps == 0) << v.name;
  }
  EXPECT_NEAR(static_cast<double>(in_calorimeter), 5 * rays, rays);
  EXPECT_NEAR(static_cast<double>(in_layer), 8 * rays, 1.6 * rays);
}

TEST(StepProfileTest, HotScenesAreThoseOfTheRun) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  Runtime runtime(world, tests::eager_options(JitMode::off));
  Navigator navigator = runtime.navigator();
  for (const Ray& ray : tests::rays_through(*world, 5, 500)) {
    tests::trace(navigator, ray, world->tolerance);
  }
  const RuntimeReport report = runtime.final_report();
  StepProfile profile = runtime.step_profile();
  std::uint64_t steps = 0, relocations = 0;
  for (const auto& v : profile.volumes) {
    EXPECT_EQ(v.name, world->volumes[v.volume].name);
    steps += v.steps;
    relocations += v.relocations;
  }
  EXPECT_EQ(steps, report.steps);
  EXPECT_GT(relocations, steps / 2);
  const Geometry geometry(world);
  const WorldFacts facts = analyse_world(geometry);
  const auto hot = hot_scenes(profile, geometry, facts, {.least_share = 0});
  EXPECT_GE(hot.size(), 5U);
  EXPECT_EQ(hot_scenes(profile, geometry, facts, {.least_share = 0, .most_scenes = 2}),
            (std::vector<VolumeId>{hot[0], hot[1]}));
  EXPECT_TRUE(hot_scenes(profile, geometry, facts, {.least_share = 1}).empty());
  profile.volumes[0].name = "other";
  EXPECT_THROW(hot_scenes(profile, geometry, facts), Error);
  profile.volumes[0] = {4000000000U, "none", 1, 1};
  EXPECT_THROW(hot_scenes(profile, geometry, facts), Error);
  profile.geometry = "other";
  EXPECT_THROW(hot_scenes(profile, geometry, facts), Error);
}

}  // namespace
}  // namespace navjit
