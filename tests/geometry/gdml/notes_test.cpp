// What is odd in a file is reported with its place, but only so many times.
#include "tests/geometry/gdml/gdml_files.hpp"

namespace navjit::testing {
namespace {

class GdmlNotes : public GdmlFiles {
 protected:
  static std::string downwards(int times) {
    std::string loops;
    for (int i = 0; i < times; ++i) loops += "\n<loop for='i' from='2' to='1' step='-1'/>";
    return Gdml{.define = "<variable name='i' value='0'/>" + loops, .structure = volume("W")};
  }
};

TEST_F(GdmlNotes, NameFileLineAndElement) {
  GdmlReport report;
  read(downwards(2), &report);
  const std::string file = (folder_ / "det.gdml").string();
  ASSERT_EQ(report.notes.size(), 2u);
  EXPECT_EQ(report.notes[0],
            file + ":4: <loop for='i'>: a loop that counts down: ran no turn, as Geant4 does");
  EXPECT_HAS(report.notes[1], file + ":5: <loop for='i'>: ");
}

TEST_F(GdmlNotes, OfOneKindTheFirstThreeAreKept) {
  GdmlReport report;
  read(downwards(1000), &report);
  ASSERT_EQ(report.notes.size(), 4u);
  EXPECT_HAS(report.notes[2], ":6: ");
  EXPECT_EQ(report.notes[3], "and 997 more: a loop that counts down: ran no turn, as Geant4 does");
}

TEST_F(GdmlNotes, KindsAreBounded) {
  std::string daughters;
  for (int i = 0; i < 1000; ++i) daughters += "<odd" + std::to_string(i) + "/>";
  GdmlReport report;
  read(Gdml{.structure = volume("W", daughters)}, &report);
  EXPECT_LT(report.notes.size() + report.skipped.size(), 200u);
  EXPECT_HAS(report.skipped.back(), "other notes (");
}

}  // namespace
}  // namespace navjit::testing
