// `navjit accuracy` as a user runs it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/plates.hpp"

namespace navjit::tests {
namespace {

namespace fs = std::filesystem;

class AccuracyCommand : public ::testing::Test {
 protected:
  AccuracyCommand() {
    folder_ = fs::path(::testing::TempDir()) / ("navjit_accuracy_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  ~AccuracyCommand() override { fs::remove_all(folder_); }

  std::string file(const char* name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

const std::string detector = std::string(NAVJIT_DETECTORS_DIR) + "/absorber.gdml";
constexpr auto npos = std::string::npos;

TEST_F(AccuracyCommand, HoldsEveryStepAgainstTheReference) {
  const Output output = run_navjit("accuracy " + detector +
                                   " --rays 100 --repetitions 1 --boundaries 1000 --vecgeom off "
                                   "--report " +
                                   file("report.json"));
  EXPECT_EQ(output.status, 0) << output.text;
  for (const char* word : {"| generic |", "| exact |", "| surface of |", "| scene |"}) {
    EXPECT_NE(output.text.find(word), npos) << output.text;
  }
  const auto report = nlohmann::json::parse(read_file(file("report.json")));
  ASSERT_EQ(report.at("engines").size(), 2u);
  for (const auto& engine : report["engines"]) {
    EXPECT_EQ(engine.at("rays"), 100);
    EXPECT_GT(engine.at("steps"), 100);
    EXPECT_EQ(engine.at("steps_as_generic"), engine["steps"]);
    EXPECT_EQ(engine.at("stuck"), 0);
    EXPECT_EQ(engine.at("lost"), 0);
    EXPECT_EQ(engine.at("overall").at("steps"), engine["steps"]);
    EXPECT_EQ(engine["overall"].at("wrong_volumes"), 0);
    EXPECT_EQ(engine["overall"].at("wrong_ends"), 0);
    EXPECT_LT(engine["overall"].at("from_surface_ulp").at("largest"), 8);
    EXPECT_LE(engine["overall"]["from_surface_ulp"].at("median"),
              engine["overall"]["from_surface_ulp"].at("99.9%"));
    EXPECT_GE(engine.at("track").at("boundaries"), 1000);
    EXPECT_TRUE(engine["track"].at("complete"));
    std::uint64_t steps = 0;
    for (const auto& scene : engine.at("scenes")) {
      steps += scene.at("steps").get<std::uint64_t>();
      EXPECT_GT(scene.at("ns_per_step"), 0) << scene;
    }
    EXPECT_EQ(steps, engine["steps"]);
  }
}

TEST_F(AccuracyCommand, TellsNoSpeedOfRaysThatMakeNoStep) {
  write_plates(file("plates.gdml"));
  write_file(file("outside.csv"), "x,y,z,dx,dy,dz\n1e6,0,0,1,0,0\n1e6,0,0,0,1,0\n");
  const Output output =
      run_navjit("accuracy " + file("plates.gdml") + " --rays " + file("outside.csv") +
                 " --repetitions 2 --boundaries 0 --vecgeom off --report " + file("report.json"));
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("| generic | 2 | 0 | 0 | - |"), npos) << output.text;
  const auto report = nlohmann::json::parse(read_file(file("report.json")));
  for (const auto& engine : report.at("engines")) {
    EXPECT_EQ(engine.at("rays_outside"), 2);
    EXPECT_TRUE(engine.at("ns_per_step").is_null()) << engine["ns_per_step"];
  }
}

TEST_F(AccuracyCommand, WritesReportsOfFilesWithAnyName) {
  write_plates(file("d\xff.gdml"));
  for (const char* observe : {"", " --observe materials"}) {
    const Output output = run_navjit("accuracy " + file("d\xff.gdml") +
                                     " --rays 5 --repetitions 1 --boundaries 0 --vecgeom off "
                                     "--report " +
                                     file("report.json") + observe);
    ASSERT_EQ(output.status, 0) << output.text;
    const auto report = nlohmann::json::parse(read_file(file("report.json")));
    EXPECT_TRUE(report.at("detector").get<std::string>().ends_with("/d\uFFFD.gdml"));
    EXPECT_NE(report.at("command").get<std::string>().find(" accuracy "), npos);
    EXPECT_FALSE(report.at("version").get<std::string>().empty());
    EXPECT_GT(report.at("machine").at("processors"), 0);
  }
}

TEST_F(AccuracyCommand, DrawsWhatObservingLessBrings) {
  const Output output =
      run_navjit("accuracy " + detector +
                 " --rays 50 --aim auto --repetitions 1 --vecgeom off --observe materials "
                 "--observe mixtures:5% --observe mixtures:20% --report " +
                 file("observed.json") + " --picture " + file("observed.svg"));
  if (output.text.find("gnuplot, which is not installed") != npos) GTEST_SKIP() << "no gnuplot";
  EXPECT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("mixtures:5%"), npos) << output.text;
  EXPECT_NE(read_file(file("observed.svg")).find("mixtures:20%"), npos);
  const auto report = nlohmann::json::parse(read_file(file("observed.json")));
  EXPECT_EQ(report["observations"].size(), 4U);
}

TEST_F(AccuracyCommand, DrawsAPictureWhereGnuplotIs) {
  write_plates(file("plates.gdml"));
  for (const char* name : {"picture.svg", "picture.png"}) {
    const Output output = run_navjit(
        "accuracy " + file("plates.gdml") +
        " --rays 20 --repetitions 1 --boundaries 0 --vecgeom off --picture " + file(name));
    if (output.text.find("gnuplot, which is not installed") != npos) {
      EXPECT_EQ(output.status, 1);
      ASSERT_NE(std::system("gnuplot --version > /dev/null 2>&1"), 0) << "it is installed";
      GTEST_SKIP() << "no gnuplot";
    }
    ASSERT_EQ(output.status, 0) << output.text;
    const std::string picture = read_file(file(name));
    EXPECT_NE(picture.find(std::string(name).ends_with("svg") ? "<svg" : "PNG"), npos);
    EXPECT_GT(picture.size(), 2000u);
  }
}

TEST_F(AccuracyCommand, SaysWhatIsWrongBeforeItMeasures) {
  const auto fails = [](const std::string& arguments, int status, const char* why) {
    const Output output = run_navjit("accuracy " + arguments);
    EXPECT_EQ(output.status, status) << arguments;
    EXPECT_NE(output.text.find(why), npos) << output.text;
  };
  fails("", 2, "detector");
  fails("nowhere.gdml --vecgeom off", 1, "nowhere.gdml");
  fails(detector + " --vecgeom off --picture " + file("picture.txt"), 2, ".svg or .png");
  fails(detector + " --vecgeom nowhere", 1, "--vecgeom nowhere: there is no such program");
  fails(detector + " --vecgeom off --rays 0", 2, "less than 1");
  fails(detector + " --vecgeom off --rays nowhere.csv", 1, "nowhere.csv");
  fails(detector + " --origin 1,2", 2, "--origin");
}

TEST_F(AccuracyCommand, GoesOnWithoutAPeerThatFails) {
  write_file(file("peer"), "#!/bin/sh\nkill -SEGV $$\n");
  fs::permissions(file("peer"), fs::perms::owner_all);
  write_plates(file("plates.gdml"));
  const Output output =
      run_navjit("accuracy " + file("plates.gdml") +
                 " --rays 20 --repetitions 1 --boundaries 0 --vecgeom " + file("peer"));
  EXPECT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("| VecGeom | crashes (signal 11) |"), npos) << output.text;
}

}  // namespace
}  // namespace navjit::tests
