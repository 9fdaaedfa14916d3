// Published detectors, from the folder that NAVJIT_DATA names, or else from that of the build.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "geometry/gdml/read_world.hpp"

namespace navjit::testing {
namespace {

namespace fs = std::filesystem;

#ifndef NAVJIT_DATA_DIR
#define NAVJIT_DATA_DIR ""
#endif

fs::path data_folder() {
  if (const char* folder = std::getenv("NAVJIT_DATA")) return folder;
  if (*NAVJIT_DATA_DIR != '\0') return NAVJIT_DATA_DIR;
  // <repository>/tests/geometry/gdml/real_files_test.cpp
  return fs::path(__FILE__).parent_path() / "../../../../shared/data";
}

struct RealFile {
  const char* name;
  std::size_t volumes;
  TouchableId touchables;  ///< to the digits known
  TouchableId touchable_precision;
  int depth;
  std::size_t most_daughters;
};

void PrintTo(const RealFile& file, std::ostream* out) { *out << file.name; }

class GdmlRealFiles : public ::testing::TestWithParam<RealFile> {};

TEST_P(GdmlRealFiles, AreReadWhole) {
  const RealFile& expected = GetParam();
  const fs::path path = data_folder() / expected.name;
  if (!fs::exists(path)) GTEST_SKIP() << path << " is not here; set NAVJIT_DATA to its folder";
  const World world = read_world(path);
  EXPECT_EQ(world.volumes.size(), expected.volumes);
  EXPECT_EQ(world.depth, expected.depth);
  const auto touchables = static_cast<double>(world.volumes[world.top].touchables);
  EXPECT_NEAR(touchables, static_cast<double>(expected.touchables),
              static_cast<double>(expected.touchable_precision) / 2);
  std::size_t most = 0;
  for (const LogicalVolume& volume : world.volumes) {
    if (volume.touchables > 0) most = std::max(most, volume.daughters.size());
  }
  EXPECT_EQ(most, expected.most_daughters);
  const std::string last = path_of(world, world.volumes[world.top].touchables - 1);
  EXPECT_EQ(last.substr(0, last.find('/')), world.volumes[world.top].name);
}

INSTANTIATE_TEST_SUITE_P(
    Published, GdmlRealFiles,
    ::testing::Values(
        RealFile{"lhcb/LHCb_Upgrade_onlyECALandHCAL.gdml", 130, 18'400'000, 100'000, 10, 70},
        RealFile{"lhcb/lhcb_full_2006.gdml", 709, 18'500'000, 100'000, 9, 277},
        RealFile{"atlas/TileTB_2B1EB.gdml", 199, 20'700, 100, 11, 306},
        RealFile{"dune/dune10kt_v1.gdml", 4729, 838'000, 1000, 6, 3702},
        RealFile{"dune/dune10kt_v6_refactored_nowires.gdml", 7530, 10'900, 100, 5, 9704},
        RealFile{"dune/nd_hall_mpd_lar_ECal12sides_42l_SPY_v3_wMuID.gdml", 4641, 182'000, 1000, 24,
                 101},
        RealFile{"alice/znenv.gdml", 15, 4400, 100, 9, 11},
        RealFile{"celeritas/testem3.gdml", 5, 152, 1, 4, 50},
        RealFile{"testem3/testEm3.gdml", 54, 152, 1, 4, 50}));

TEST(GdmlRealFolder, EveryFileIsReadOrRefusedWithAReason) {
  const fs::path folder = data_folder();
  if (!fs::is_directory(folder)) {
    GTEST_SKIP() << folder << " is not here; set NAVJIT_DATA to a folder of detectors";
  }
  int read_well = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".gdml") continue;
    try {
      const World world = read_world(entry.path());
      EXPECT_GT(world.volumes[world.top].touchables, 0u) << entry.path();
      ++read_well;
    } catch (const GdmlError& e) {
      const std::string message = e.what();
      EXPECT_EQ(message.find(entry.path().string()), 0u) << message;
      // Some of the files are of solids that cannot be: Geant4 complains of them as well.
      EXPECT_TRUE(message.find("unsupported") != std::string::npos ||
                  message.find("a twisted tube needs") != std::string::npos)
          << message;
    }
  }
  EXPECT_GT(read_well, 0);
}

}  // namespace
}  // namespace navjit::testing
