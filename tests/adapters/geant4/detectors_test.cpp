// Detectors from files, as Geant4 reads them.
#include <gtest/gtest.h>
#include <G4GDMLParser.hh>
#include <G4GeometryManager.hh>
#include <G4LogicalVolumeStore.hh>
#include <G4PhysicalVolumeStore.hh>
#include <G4SolidStore.hh>

#include <filesystem>

#include "tests/adapters/geant4/walk.hpp"

namespace navjit {
namespace {

struct Sample {
  std::string file;
  tests::Walk walk{};
  /// Steps that may differ: where a file's volumes overlap, or nearly do.
  double share_that_may_differ = 1e-5;
};

void walk_alike(const Sample& sample) {
  if (!std::filesystem::exists(sample.file)) GTEST_SKIP() << sample.file << " is not there";
  G4GDMLParser parser;
  parser.SetStripFlag(false);
  parser.Read(sample.file, false);
  const tests::Walked walked = tests::walk(*parser.GetWorldVolume(), sample.walk);
  EXPECT_EQ(walked.refusal, "");
  const geant4::Differences& found = walked.counts.differences;
  EXPECT_GT(found.steps, 10000U);
  EXPECT_LE(static_cast<double>(found.lengths + found.histories),
            1 + sample.share_that_may_differ * static_cast<double>(found.steps));
  EXPECT_LT(found.largest_length, 1e-6);
  EXPECT_EQ(walked.counts.abandoned, 0U);
  G4GeometryManager::GetInstance()->OpenGeometry();
  G4PhysicalVolumeStore::Clean();
  G4LogicalVolumeStore::Clean();
  G4SolidStore::Clean();
}

const std::string own = NAVJIT_DETECTORS_DIR "/";
const std::string published = NAVJIT_DATA_DIR "/";

TEST(Detectors, OfThisProject) { walk_alike({own + "shashlik.gdml", {.tracks = 2000}}); }

TEST(Detectors, TestEm3) { walk_alike({published + "testem3/testEm3.gdml", {.tracks = 1000}}); }

}  // namespace
}  // namespace navjit
