// What `navjit run` does and what it reports.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"

namespace navjit {
namespace {

using nlohmann::json;
using tests::run_navjit;

const std::string shashlik = NAVJIT_DETECTORS_DIR "/shashlik.gdml";

class Run : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }
  /// Runs it with a report, and gives that.
  json run(const std::string& arguments) const {
    const std::string path = file("report.json");
    const tests::Output output = run_navjit("run " + arguments + " --report " + path);
    EXPECT_EQ(output.status, 0) << output.text;
    return json::parse(tests::read_file(path));
  }

  tests::TemporaryFolder folder_;
};

TEST_F(Run, TheReportHasWhatItPromises) {
  for (const std::string jit : {"on", "off", "wait", "shadow"}) {
    SCOPED_TRACE(jit);
    const json report = run(shashlik + " --aim auto --rays 2e3 --threads 2 --jit " + jit);
    for (const char* key :
         {"seconds", "cpu_seconds", "steps_per_second", "warm_steps_per_second"}) {
      EXPECT_GT(report.at(key), 0) << key;
    }
    EXPECT_EQ(report.at("rays"), 2000);
    EXPECT_EQ(report.at("interrupted"), false);
    EXPECT_FALSE(report.at("version").get<std::string>().empty());
    const auto& machine = report.at("machine");
    EXPECT_GE(machine.at("processors"), 1);
    EXPECT_FALSE(machine.at("system").get<std::string>().empty());
    const auto command = report.at("command").get<std::string>();
    EXPECT_NE(command.find(" run " + shashlik + " --aim auto --rays 2e3 "), std::string::npos)
        << command;
    EXPECT_EQ(report.at("speedup").is_number(), jit == "on" || jit == "wait");
    EXPECT_EQ(report.at("compile_cpu_seconds") > 0, jit != "off");
    const double share = report.at("share_specialised");
    EXPECT_TRUE(share >= 0 && share <= 1 + 1e-9);
    double specialised = 0;
    for (const json& scene : report.at("scenes")) {
      const auto binding = scene.at("binding").get<std::string>();
      EXPECT_TRUE(binding == "generic" || binding == "data" || binding == "constants") << binding;
      const bool is_specialised = binding != "generic";
      EXPECT_FALSE(scene.at("structure").get<std::string>().empty()) << scene.at("volume");
      specialised += is_specialised ? scene.at("share").get<double>() : 0;
    }
    EXPECT_NEAR(share, specialised, 1e-9);
    EXPECT_EQ(report.at("specialised_50_at_s").is_number(), share >= 0.5);
    EXPECT_EQ(report.at("specialised_90_at_s").is_number(), share >= 0.9);
    EXPECT_TRUE(jit != "wait" || share > 0.5) << share;
    EXPECT_TRUE(jit != "off" || share == 0) << share;
  }
}

TEST_F(Run, TheComparisonIsAPartOfTheRun) {
  const json report = run(shashlik + " --aim auto --rays 4e4 --jit wait");
  EXPECT_GT(report.at("compared").at("rays"), 0);
  EXPECT_LT(report.at("compared").at("rays"), 40000) << "a quarter of the time, in turn";
}

TEST_F(Run, TakesRaysOfAFile) {
  tests::write_file(file("rays.csv"),
                    "x,y,z,dx,dy,dz\n0,0,0,0,0,1\n0,0,0,0.1,0.2,2\n1e9,0,0,1,0,0\n");
  const json report = run(shashlik + " --rays " + file("rays.csv"));
  EXPECT_EQ(report.at("rays"), 3);
  // The same as a trace's rows.
  const tests::Output trace = run_navjit("trace " + shashlik + " --rays " + file("rays.csv") +
                                         " --out " + file("steps.csv"));
  EXPECT_EQ(trace.status, 0) << trace.text;
  const std::string rows = tests::read_file(file("steps.csv"));
  EXPECT_EQ(report.at("steps"),
            static_cast<std::size_t>(std::count(rows.begin(), rows.end(), '\n')) - 1);
}

TEST_F(Run, AimedRaysMeetTheDetectorInEveryCommand) {
  const auto steps_of_trace = [](const std::string& aim) {
    const tests::Output output = run_navjit("trace " + shashlik + " --rays 200 --jit off" + aim);
    EXPECT_EQ(output.status, 0) << output.text;
    return static_cast<std::uint64_t>(std::count(output.text.begin(), output.text.end(), '\n')) - 1;
  };
  const std::uint64_t aimed = steps_of_trace(" --aim InnerLead");
  EXPECT_GT(aimed, 2 * steps_of_trace(""));
  EXPECT_EQ(run(shashlik + " --rays 200 --jit off --aim InnerLead").at("steps"), aimed);
}

TEST_F(Run, RaysThatContradictEachOtherAreWrongUsage) {
  tests::write_file(file("rays.csv"), "x,y,z,dx,dy,dz\n0,0,0,0,0,1\n");
  for (const std::string command : {"run ", "trace ", "accuracy "}) {
    for (const std::string options :
         {" --rays 10 --aim auto --eta 1,2", " --rays 10 --aim auto --origin 0,0,0", " --rays 1.5",
          " --rays -1", " --rays 0", " --rays 1e30", " --rays lots", " --aim"}) {
      const tests::Output output = run_navjit(command + shashlik + options);
      EXPECT_EQ(output.status, 2) << command << options << ": " << output.text;
      EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
    }
    for (const std::string option : {" --seed 2", " --aim auto", " --origin 0,0,0", " --eta 1,2"}) {
      const tests::Output output =
          run_navjit(command + shashlik + " --rays " + file("rays.csv") + option);
      EXPECT_EQ(output.status, 2) << command << option << ": " << output.text;
    }
    const tests::Output nobody = run_navjit(command + shashlik + " --rays 10 --aim nobody");
    EXPECT_EQ(nobody.status, 1) << nobody.text;
    EXPECT_NE(nobody.text.find("'nobody'"), std::string::npos) << nobody.text;
    const tests::Output outside = run_navjit(command + shashlik + " --rays 10 --origin 1e9,0,0");
    EXPECT_EQ(outside.status, 1) << outside.text;
    EXPECT_NE(outside.text.find("is outside the world"), std::string::npos) << outside.text;
  }
}

}  // namespace
}  // namespace navjit
