// `navjit warmup` as a user runs it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/plates.hpp"

namespace navjit::tests {
namespace {

constexpr auto npos = std::string::npos;
const std::string detector = std::string(NAVJIT_DETECTORS_DIR) + "/absorber.gdml";

/// The number of files that navjit has left in the folder for temporary files.
std::size_t leftovers(const std::string& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

/// Whether the runs of that mode had time for a swap and, if they have a cache, whether it holds
/// something. Scenes are bound to data first, so that a short run may compile nothing.
bool swapped(const nlohmann::json& report, const std::string& mode) {
  const auto& variants = report.at("variants");
  return std::all_of(variants.begin(), variants.end(), [&](const auto& variant) {
    const auto& runs = variant.at("runs");
    return variant.at("mode") != mode ||
           std::none_of(runs.begin(), runs.end(), [&](const auto& run) {
             return run.at("swaps").empty() || (mode == "cache" && run.at("cached_modules") == 0);
           });
  });
}

TEST(WarmupCommand, ComparesTheWaysToStart) {
  const TemporaryFolder folder, temporary;
  write_plates(folder.file("plates.gdml"));
  Output output{0, {}};
  nlohmann::json report;
  // A fraction of a second is enough, unless the machine has too much else to do.
  for (const char* seconds : {"0.3", "2", "15"}) {
    output =
        run_command("TMPDIR=" + temporary.path() + " " NAVJIT_COMMAND,
                    "warmup " + folder.file("plates.gdml") + " --seconds " + seconds + " --prime " +
                        seconds + " --repetitions 2 --interval 0.01 --nice 0 --report " +
                        folder.file("report.json") + " --csv " + folder.file("points.csv"));
    ASSERT_EQ(output.status, 0) << output.text;
    report = nlohmann::json::parse(read_file(folder.file("report.json")));
    if (swapped(report, "cache") && swapped(report, "plugin")) break;
  }
  for (const char* row : {"| off |", "| cold |", "| cache |", "| plugin |", "break-even"}) {
    EXPECT_NE(output.text.find(row), npos) << output.text;
  }
  EXPECT_EQ(leftovers(temporary.path()), 0U);
  EXPECT_TRUE(report.at("same_rays"));
  ASSERT_EQ(report.at("variants").size(), 4U);
  std::size_t points = 0;
  for (const auto& variant : report["variants"]) {
    const std::string mode = variant.at("mode");
    for (const char* field : {"steps_per_second", "speed_up", "break_even_s", "half_specialised_s",
                              "most_specialised_s", "specialised_share", "cost_s"}) {
      EXPECT_TRUE(variant.contains(field)) << field;
    }
    EXPECT_GT(variant["steps_per_second"].at("median"), 0);
    EXPECT_LE(variant["steps_per_second"].at("low"), variant["steps_per_second"].at("high"));
    ASSERT_EQ(variant.at("runs").size(), 2U);
    for (const auto& run : variant["runs"]) {
      EXPECT_EQ(run.at("stuck"), 0);
      const auto& series = run.at("series");
      points += series.size();
      EXPECT_EQ(series.back().at(1), run.at("steps"));
      EXPECT_EQ(series.back().at(2), run.at("navigating_s"));
      for (std::size_t i = 1; i < series.size(); ++i) {
        EXPECT_GT(series[i].at(0), series[i - 1].at(0));
        EXPECT_GE(series[i].at(1), series[i - 1].at(1));
        EXPECT_GE(series[i].at(2), series[i - 1].at(2)) << "processor time";
      }
      double share = 0;
      for (const auto& swap : run.at("swaps")) share += swap.at(1).get<double>();
      EXPECT_LE(share, 1 + 1e-9);
      if (mode == "off") {
        EXPECT_EQ(run.at("modules"), 0);
        EXPECT_TRUE(run["swaps"].empty());
      }
      if (mode == "plugin" || mode == "cache") {
        EXPECT_FALSE(run["swaps"].empty()) << mode;
      }
      if (mode == "cache") {
        EXPECT_GT(run.at("cached_modules"), 0);
      }
    }
  }
  std::istringstream csv(read_file(folder.file("points.csv")));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line,
            "variant,repetition,seconds,steps,steps_per_second,specialised_share,processor_s");
  std::size_t lines = 0;
  while (std::getline(csv, line)) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 6);
    ++lines;
  }
  EXPECT_EQ(lines, points);
}

TEST(WarmupCommand, VariesWhatIsAskedFor) {
  const TemporaryFolder folder;
  const Output output = run_navjit("warmup " + detector +
                                   " --seconds 0.2 --repetitions 1 --modes cold --opt 0,1 "
                                   "--origin 0,0,0 --eta 1,2 --threads 2 --report " +
                                   folder.file("report.json"));
  ASSERT_EQ(output.status, 0) << output.text;
  const auto report = nlohmann::json::parse(read_file(folder.file("report.json")));
  ASSERT_EQ(report.at("variants").size(), 3U);
  EXPECT_EQ(report["variants"][1].at("name"), "cold -O0");
  EXPECT_EQ(report["variants"][2].at("name"), "cold -O1");
  EXPECT_EQ(report.at("threads"), 2);
}

TEST(WarmupCommand, WritesReportsOfFilesWithAnyName) {
  const TemporaryFolder folder;
  write_plates(folder.file("d\xff.gdml"));
  const Output output = run_navjit("warmup " + folder.file("d\xff.gdml") +
                                   " --seconds 0.1 --repetitions 1 --modes cold --report " +
                                   folder.file("report.json"));
  ASSERT_EQ(output.status, 0) << output.text;
  const auto report = nlohmann::json::parse(read_file(folder.file("report.json")));
  EXPECT_TRUE(report.at("detector").get<std::string>().ends_with("/d\uFFFD.gdml"));
  EXPECT_NE(report.at("command").get<std::string>().find(" warmup "), npos);
  EXPECT_FALSE(report.at("version").get<std::string>().empty());
  EXPECT_GT(report.at("machine").at("processors"), 0);
}

TEST(WarmupCommand, DrawsAPictureWhereGnuplotIs) {
  const TemporaryFolder folder;
  for (const char* name : {"picture.svg", "picture.png"}) {
    const Output output =
        run_navjit("warmup " + detector + " --seconds 0.1 --repetitions 1 --modes cold --picture " +
                   folder.file(name));
    if (output.text.find("gnuplot, which is not installed") != npos) {
      EXPECT_EQ(output.status, 1);
      ASSERT_NE(std::system("gnuplot --version > /dev/null 2>&1"), 0) << "it is installed";
      GTEST_SKIP() << "no gnuplot";
    }
    ASSERT_EQ(output.status, 0) << output.text;
    const std::string picture = read_file(folder.file(name));
    EXPECT_NE(picture.find(std::string(name).ends_with("svg") ? "<svg" : "PNG"), npos);
    EXPECT_GT(picture.size(), 2000U);
  }
}

TEST(WarmupCommand, SaysWhatIsWrongBeforeItMeasures) {
  const TemporaryFolder folder;
  const auto fails = [](const std::string& arguments, int status, const char* why) {
    const Output output = run_navjit("warmup " + arguments);
    EXPECT_EQ(output.status, status) << arguments;
    EXPECT_NE(output.text.find(why), npos) << output.text;
    EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
  };
  fails("", 2, "detector");
  fails("nowhere.gdml", 1, "nowhere.gdml");
  fails(detector + " --seconds 0", 2, "--seconds");
  fails(detector + " --seconds -1", 2, "--seconds");
  fails(detector + " --seconds nan", 2, "--seconds");
  fails(detector + " --interval 0", 2, "--interval");
  fails(detector + " --interval 0.001 --seconds 250", 2, "give 0.0013 or more");
  fails(detector + " --interval 0.001 --seconds 1 --prime 3600", 2, "--interval");
  fails(detector + " --repetitions 0", 2, "--repetitions");
  fails(detector + " --modes warm", 2, "--modes");
  fails(detector + " --opt 4", 2, "--opt");
  fails(detector + " --eta 1", 2, "--eta");
  fails(detector + " --origin 1,2,inf", 2, "--origin");
  fails(detector + " --threads 0", 2, "--threads");
  fails(detector + " --picture " + folder.file("picture.txt"), 2, ".svg or .png");
}

TEST(WarmupCommand, NeedsACompiler) {
  const Output output = run_command(NAVJIT_PRODUCTION, "warmup " + detector);
  EXPECT_EQ(output.status, 1);
  EXPECT_NE(output.text.find("built without a compiler"), npos) << output.text;
}

}  // namespace
}  // namespace navjit::tests
