// `navjit trace` writes the same bytes, whatever the JIT does and however many threads there are.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/command.hpp"

namespace navjit {
namespace {

using tests::read_file;
using tests::run_navjit;

namespace fs = std::filesystem;

class TraceOfDetector : public testing::TestWithParam<std::string> {};

TEST_P(TraceOfDetector, DoesNotDependOnTheJitOrOnThreads) {
  const bool shipped = GetParam().find('/') == std::string::npos;
  const fs::path detector =
      fs::path(shipped ? NAVJIT_DETECTORS_DIR : NAVJIT_DATA_DIR) / (GetParam() + ".gdml");
  if (!shipped && !fs::exists(detector)) GTEST_SKIP() << detector << " is not there";
  const fs::path folder = fs::path(testing::TempDir()) / ("trace_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const auto trace = [&](const std::string& options) {
    const fs::path out = folder / "steps.csv";
    const tests::Output output = run_navjit("trace " + detector.string() + " --seed 7 --out " +
                                            out.string() + " " + options);
    EXPECT_EQ(output.status, 0) << output.text;
    return read_file(out);
  };
  const std::string right = trace("--rays 1500 --jit off");
  EXPECT_EQ(right.substr(0, right.find('\n')), "ray,step,volume,length");
  EXPECT_GT(std::count(right.begin(), right.end(), '\n'), 1500);
  EXPECT_EQ(right.find("stuck"), std::string::npos);
  for (const char* options :
       {"--jit off --threads 4", "--jit on", "--jit on --threads 4", "--jit shadow"}) {
    EXPECT_TRUE(right == trace(std::string("--rays 1500 ") + options)) << options;
  }
  // The second has its code from the first.
  const std::string cache = " --cache " + (folder / "cache").string();
  for (const char* options : {"--jit wait", "--jit wait --threads 4"}) {
    EXPECT_TRUE(right == trace(std::string("--rays 1500 ") + options + cache)) << options;
  }
  for (const char* boxes :
       {"linear", "wide-tree", "two-level", "two-level:k-means", "two-level:furthest",
        "regular-tree", "regular-tree:k-means", "regular-tree:furthest", "regular-tree,*=auto"}) {
    EXPECT_TRUE(right == trace(std::string("--rays 1500 --jit off --boxes ") + boxes)) << boxes;
  }
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Apps, TraceOfDetector,
                         testing::Values("shashlik", "barrel", "absorber", "testem3/testEm3",
                                         "lhcb/LHCb_Upgrade_onlyECALandHCAL"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::replace(name.begin(), name.end(), '/', '_');
                           return name;
                         });

TEST(Trace, ReadsRaysFromAFileAndNormalisesDirections) {
  const fs::path rays = fs::path(testing::TempDir()) / ("rays" + std::to_string(getpid()) + ".csv");
  tests::write_file(rays, "x,y,z,dx,dy,dz\n0,0,0,0,0,7\n1e9,0,0,1,0,0\n");
  const tests::Output output =
      run_navjit("trace " NAVJIT_DETECTORS_DIR "/absorber.gdml --rays " + rays.string());
  EXPECT_EQ(output.status, 0);
  EXPECT_NE(output.text.find("\n0,0,"), std::string::npos);
  EXPECT_EQ(output.text.find("\n1,"), std::string::npos);  // starts outside: no rows
  fs::remove(rays);
}

}  // namespace
}  // namespace navjit
