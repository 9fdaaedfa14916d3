#include "runtime/fingerprint.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <string>

#include "geometry/gdml/read_world.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

namespace fs = std::filesystem;

std::string fingerprint(World world) {
  return geometry_fingerprint(Geometry(std::make_shared<const World>(std::move(world))));
}

TEST(Fingerprint, ChangesWithAllThatMovesABoundaryAndWithNothingElse) {
  const std::string right = fingerprint(tests::mixed_world());
  EXPECT_EQ(right.size(), 64U);
  EXPECT_EQ(fingerprint(tests::mixed_world()), right);
  const auto changed = [](const std::function<void(World&)>& change) {
    World world = tests::mixed_world();
    change(world);
    finish(world);
    return fingerprint(std::move(world));
  };
  EXPECT_EQ(changed([](World& w) { w.volumes[1].daughters[0].name = "other"; }), right);
  EXPECT_EQ(changed([](World& w) { w.volumes[1].daughters[0].copy_number = 7; }), right);
  EXPECT_EQ(changed([](World& w) { w.materials.push_back({}); }), right);
  std::set<std::string> others{right};
  const std::vector<std::function<void(World&)>> changes{
      [](World& w) { w.volumes[1].name = "other"; },
      [](World& w) { w.volumes[2].solid = make_box("plate", 20, 20, std::nextafter(1, 2)); },
      [](World& w) {
        double& z = w.volumes[1].daughters[0].transformation.translation[2];
        z = std::nextafter(z, 0);
      },
      [](World& w) { std::swap(w.volumes[1].daughters[0], w.volumes[1].daughters[1]); },
      [](World& w) { w.volumes[1].daughters.pop_back(); },
      [](World& w) { w.tolerance_rule.absolute *= 2; },
  };
  for (const auto& change : changes) {
    EXPECT_TRUE(others.insert(changed(change)).second) << others.size();
  }
}

TEST(Fingerprint, IsTheSameEachTimeAFileIsRead) {
  std::vector<fs::path> files;
  for (const char* folder : {NAVJIT_DETECTORS_DIR, NAVJIT_DATA_DIR "/solids"}) {
    if (!fs::is_directory(folder)) continue;
    for (const auto& file : fs::directory_iterator(folder)) {
      if (file.path().extension() == ".gdml") files.push_back(file.path());
    }
  }
  std::size_t read = 0;
  for (const fs::path& file : files) {
    World first, second;
    try {
      first = read_world(file);
    } catch (const std::exception&) {
      continue;  // refused; other tests look at that
    }
    second = read_world(file);
    EXPECT_EQ(fingerprint(std::move(first)), fingerprint(std::move(second))) << file;
    ++read;
  }
  EXPECT_GE(read, 3U);
}

TEST(Fingerprint, OfTheGeneratorIsMadeOfAllItsSources) {
  std::ifstream in(NAVJIT_GENERATOR_FINGERPRINT);
  std::set<std::string> counted;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("//   ")) counted.insert(line.substr(5));
  }
  const fs::path root = NAVJIT_SOURCE_DIR;
  for (const char* folder : {"analysis", "codegen", "geometry/kernels"}) {
    std::size_t sources = 0;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (!entry.is_regular_file() || entry.path().filename() == "CMakeLists.txt") continue;
      ++sources;
      EXPECT_TRUE(counted.contains(fs::relative(entry.path(), root))) << entry.path();
    }
    EXPECT_GT(sources, 10U) << folder;
  }
}

}  // namespace
}  // namespace navjit
