// Four processes of navjit under mpirun make one run together.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/folder.hpp"
#include "tests/support/process.hpp"

namespace navjit::tests {
namespace {

using nlohmann::json;
const std::string detector = NAVJIT_DETECTORS_DIR "/shashlik.gdml";

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The lines that come from navjit and not from the launcher.
std::vector<std::string> errors_in(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("navjit: ")) lines.push_back(line);
  }
  return lines;
}

class Mpi : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(NAVJIT_MPIEXEC).empty()) GTEST_SKIP() << "navjit was built without MPI";
    // As root, on fewer processors than processes, and with no way to other machines.
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
    setenv("OMPI_MCA_plm_rsh_agent", "", 1);
  }
  std::string file(const std::string& name) const { return folder_.file(name); }
  json report(const std::string& name) const { return json::parse(read_file(file(name))); }
  static Output mpirun(const std::string& command) {
    return run_command(NAVJIT_MPIEXEC, "-n 4 " + command);
  }
  static Output four(const std::string& options) { return mpirun(NAVJIT_COMMAND " " + options); }

  TemporaryFolder folder_;
};

TEST_F(Mpi, FourProcessesMakeTheRunOfOne) {
  const std::string same = "run " + detector + " --jit off --rays 4003 ";
  const Output one =
      run_navjit(same + "--report " + file("one.json") + " --save-profile " + file("one.profile"));
  ASSERT_EQ(one.status, 0) << one.text;
  const Output all = four(same + "--report " + file("all.json") + " --save-profile " +
                          file("all.profile") + " --html " + file("all.html"));
  ASSERT_EQ(all.status, 0) << all.text;
  const json a = report("one.json"), b = report("all.json");
  EXPECT_EQ(b.at("processes"), 4);
  EXPECT_FALSE(b.contains("part"));
  for (const auto& [key, value] : a.items()) EXPECT_TRUE(b.contains(key)) << key;
  for (const char* key : {"rays", "steps", "stuck", "detector", "jit", "interrupted", "observe"}) {
    EXPECT_EQ(a.at(key), b.at(key)) << key;
  }
  EXPECT_NEAR(a["length_mm"].get<double>(), b["length_mm"].get<double>(),
              1e-9 * a["length_mm"].get<double>());
  const auto steps_of = [](const json& rows, const char* name) {
    std::map<std::string, std::uint64_t> steps;
    for (const json& row : rows) {
      const auto made = row.at("steps").get<std::uint64_t>();
      if (made > 0) steps[row.at(name)] += made;
    }
    return steps;
  };
  EXPECT_EQ(steps_of(a["scenes"], "volume"), steps_of(b["scenes"], "volume"));
  const json p = report("one.profile"), q = report("all.profile");
  EXPECT_EQ(p.at("geometry"), q.at("geometry"));
  EXPECT_EQ(q.at("runs"), 4);
  EXPECT_EQ(steps_of(p["volumes"], "name"), steps_of(q["volumes"], "name"));
  EXPECT_TRUE(contains(read_file(file("all.html")), "</html>"));
  // Only the first process speaks.
  EXPECT_TRUE(contains(all.text, "4003 rays")) << all.text;
  EXPECT_TRUE(contains(all.text, "4 processes, 4 threads")) << all.text;
  EXPECT_EQ(all.text.find("OuterCell"), all.text.rfind("OuterCell")) << all.text;
}

TEST_F(Mpi, OneCacheServesAll) {
  const std::string same = "run " NAVJIT_DETECTORS_DIR
                           "/absorber.gdml --opt 0 --jit wait --rays 400 --cache " +
                           file("cache") + " --report " + file("r.json");
  ASSERT_EQ(four(same).status, 0);
  const json first = report("r.json");
  ASSERT_GT(first.at("modules"), 0);
  ASSERT_EQ(four(same).status, 0);
  const json second = report("r.json");
  EXPECT_GT(second.at("modules"), 0);
  EXPECT_EQ(second.at("cached_modules"), second.at("modules"));
  EXPECT_EQ(first.at("steps"), second.at("steps"));
  EXPECT_GT(second.at("speedup"), 0);
  EXPECT_GT(second.at("compared").at("rays"), 0);
}

TEST_F(Mpi, WhatAllGetWrongIsSaidOnce) {
  const Output usage = four("run " + detector + " --rays x");
  EXPECT_EQ(usage.status, 2) << usage.text;
  EXPECT_EQ(errors_in(usage.text).size(), 1U) << usage.text;
  const Output missing = four("run " + file("none.gdml") + " --rays 10");
  EXPECT_EQ(missing.status, 1) << missing.text;
  EXPECT_EQ(errors_in(missing.text).size(), 1U) << missing.text;
  const Output unwritable =
      four("run " + detector + " --rays 10 --report " + file("no/such/folder.json"));
  EXPECT_EQ(unwritable.status, 1) << unwritable.text;
  EXPECT_EQ(errors_in(unwritable.text).size(), 1U) << unwritable.text;
  const Output full = four("run " + detector + " --jit off --rays 10 --report /dev/full");
  EXPECT_EQ(full.status, 1) << full.text;
  EXPECT_EQ(errors_in(full.text).size(), 1U) << full.text;
}

TEST_F(Mpi, WhatOneGetsWrongEndsAll) {
  write_file(file("mixed"), "#!/bin/sh\nd=" + detector +
                                "\n[ \"$OMPI_COMM_WORLD_RANK\" = 2 ] && d=" + file("none.gdml") +
                                "\nexec " NAVJIT_COMMAND " run $d --jit off --rays 1e12\n");
  std::filesystem::permissions(file("mixed"), std::filesystem::perms::owner_all);
  const Output output = mpirun(file("mixed"));
  EXPECT_EQ(output.status, 1) << output.text;
  const auto errors = errors_in(output.text);
  ASSERT_EQ(errors.size(), 1U) << output.text;
  EXPECT_TRUE(contains(errors[0], "none.gdml")) << errors[0];
  EXPECT_TRUE(contains(errors[0], "process 3 of 4")) << errors[0];
}

TEST_F(Mpi, WhatFailsUnderWayEndsAll) {
  // The rays of the last quarter have a line that is none.
  std::string rays = "x,y,z,dx,dy,dz\n";
  for (int i = 0; i < 4000; ++i) rays += i == 3500 ? "0,0,0,1\n" : "0,0,0,0,0.1,1\n";
  write_file(file("rays.csv"), rays);
  const Output output = four("run " + detector + " --jit off --rays " + file("rays.csv"));
  EXPECT_EQ(output.status, 1) << output.text;
  EXPECT_EQ(errors_in(output.text).size(), 1U) << output.text;
  EXPECT_TRUE(contains(output.text, "rays.csv:3502")) << output.text;
}

TEST_F(Mpi, PartsAreRunsOfTheirOwn) {
  const Output output =
      mpirun("sh -c '" NAVJIT_COMMAND " run " + detector +
             " --jit off --rays 100 --part $((OMPI_COMM_WORLD_RANK+1))/4 --report " + file("part") +
             "$OMPI_COMM_WORLD_RANK'");
  ASSERT_EQ(output.status, 0) << output.text;
  for (const std::string part : {"1", "2", "3", "4"}) {
    EXPECT_EQ(report("part" + std::to_string(std::stoi(part) - 1)).at("part"), part + "/4");
  }
}

TEST_F(Mpi, ASignalToOneEndsAll) {
  Process run({NAVJIT_MPIEXEC, "-n", "4", NAVJIT_COMMAND, "-v", "run", detector, "--jit", "off",
               "--rays", "1e12", "--report", file("report.json")},
              file("log"));
  // The launcher's children are threads' children, and the last one's rank is not the first.
  std::vector<pid_t> children;
  ASSERT_TRUE(eventually([&] {
    children.clear();
    const std::string task = "/proc/" + std::to_string(run.pid()) + "/task";
    for (const auto& thread : std::filesystem::directory_iterator(task)) {
      std::ifstream in(thread.path() / "children");
      for (pid_t child = 0; in >> child;) children.push_back(child);
    }
    return children.size() == 4;
  })) << run.text();
  // They note a signal while they transport: each then has threads that work and watch.
  ASSERT_TRUE(eventually([&] {
    for (const pid_t child : children) {
      std::ifstream in("/proc/" + std::to_string(child) + "/stat");
      std::string stat;
      std::getline(in, stat);
      std::istringstream fields(stat.substr(std::min(stat.size(), stat.rfind(')') + 1)));
      std::string skipped;
      for (int i = 0; i < 11; ++i) fields >> skipped;
      double ticks = 0;
      if (!(fields >> ticks) || ticks < 40) return false;
    }
    return true;
  })) << run.text();
  kill(children[2], SIGTERM);
  EXPECT_EQ(run.wait(), 128 + SIGTERM) << run.text();
  const json made = report("report.json");
  EXPECT_TRUE(made.at("interrupted"));
  EXPECT_GT(made.at("rays"), 0);
  EXPECT_EQ(made.at("processes"), 4);
  EXPECT_EQ(errors_in(run.text()).size(), 1U) << run.text();
}

TEST(WithoutMpi, ALauncherThatIsNotFoundIsSaid) {
  // A launcher of another MPI, whose processes do not find one another.
  const std::string command = "PMI_RANK=0 PMI_SIZE=3 " NAVJIT_COMMAND " run " + detector;
  const Output output = run_command("env", command + " --jit off --rays 10");
  EXPECT_EQ(output.status, 1) << output.text;
  ASSERT_EQ(errors_in(output.text).size(), 1U) << output.text;
  EXPECT_TRUE(contains(output.text, "one of 3 processes")) << output.text;
  EXPECT_TRUE(contains(output.text, "--part K/N")) << output.text;
  const Output part = run_command("env", command + " --jit off --rays 10 --part 1/3");
  EXPECT_EQ(part.status, 0) << part.text;
}

TEST(WithoutMpi, OneProcessIsAlone) {
  for (const std::string variables :
       {"OMPI_COMM_WORLD_RANK=0 OMPI_COMM_WORLD_SIZE=1", "OMPI_COMM_WORLD_RANK=x", "PMI_RANK=-1",
        "PMI_RANK=0 PMI_SIZE=1", "PMI_RANK="}) {
    const Output output = run_command(
        "env", variables + " " NAVJIT_COMMAND " run " + detector + " --jit off --rays 10");
    EXPECT_EQ(output.status, 0) << variables << output.text;
    EXPECT_TRUE(contains(output.text, "10 rays")) << output.text;
    EXPECT_FALSE(contains(output.text, "processes")) << output.text;
  }
}

}  // namespace
}  // namespace navjit::tests
