// INT, TERM, HUP, and the warnings of batch systems: results so far are written, nothing is left
// behind, exit status is 128 + n.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/support/folder.hpp"
#include "tests/support/plates.hpp"
#include "tests/support/process.hpp"
#include "tests/support/sanitizers.hpp"

namespace navjit::tests {
namespace {

namespace fs = std::filesystem;
const std::string detector = NAVJIT_DETECTORS_DIR "/shashlik.gdml";

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

/// A child of the process; 0 if it has none.
pid_t child_of(pid_t pid) {
  std::ifstream in("/proc/" + std::to_string(pid) + "/task/" + std::to_string(pid) + "/children");
  pid_t child = 0;
  in >> child;
  return child;
}

bool has_child(pid_t pid) { return child_of(pid) != 0; }

/// The processor time that a process has used so far.
double processor_seconds(pid_t pid) {
  clockid_t clock{};
  timespec used{};
  if (clock_getcpuclockid(pid, &clock) != 0 || clock_gettime(clock, &used) != 0) return 0;
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

class Signals : public testing::TestWithParam<int> {
 protected:
  TemporaryFolder folder_, log_;
  int number_ = GetParam();
};

TEST_P(Signals, TraceLeavesTheRaysThatAreComplete) {
  const std::string out = folder_.file("steps.csv");
  write_file(out, "before");
  Process trace({NAVJIT_COMMAND, "trace", detector, "--rays", "1e12", "--threads", "3", "--jit",
                 "off", "--out", out},
                log_.file("log"));
  // Beside it a file grows.
  ASSERT_TRUE(eventually([&] {
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      std::error_code gone;
      if (entry.path() != out && entry.file_size(gone) > 500000 && !gone) return true;
    }
    return false;
  })) << trace.text();
  EXPECT_EQ(read_file(out), "before");
  trace.send(number_);
  EXPECT_EQ(trace.wait(), 128 + number_) << trace.text();
  EXPECT_EQ(files_in(folder_.path()), std::vector<std::string>{"steps.csv"});
  const std::string text = read_file(out);
  ASSERT_EQ(text.back(), '\n');
  const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
  const std::uint64_t rays = std::stoull(text.substr(last)) + 1;
  const Output whole =
      run_navjit("trace " + detector + " --jit off --rays " + std::to_string(rays));
  EXPECT_TRUE(whole.text == text) << "the first " << rays << " rays, complete";
}

TEST_P(Signals, RunWritesWhatItHas) {
  Process run(
      {NAVJIT_COMMAND, "-v", "run", detector, "--rays", "1e8", "--threads", "2", "--nice", "0",
       "--report", folder_.file("report.json"), "--save-profile", folder_.file("profile.json")},
      log_.file("log"));
  ASSERT_TRUE(run.says("event=")) << run.text();
  run.send(number_);
  EXPECT_EQ(run.wait(), 128 + number_) << run.text();
  EXPECT_EQ(files_in(folder_.path()), (std::vector<std::string>{"profile.json", "report.json"}));
  const auto report = nlohmann::json::parse(read_file(folder_.file("report.json")));
  EXPECT_GT(report.at("rays"), 0);
  EXPECT_LT(report.at("rays"), 1e8);
  EXPECT_GT(report.at("steps"), report.at("rays"));
  EXPECT_NE(run.text().find("M steps/s"), std::string::npos) << run.text();
  const Output merged = run_navjit("profile merge " + folder_.file("profile.json") + " -o " +
                                   folder_.file("merged.json"));
  EXPECT_EQ(merged.status, 0) << merged.text;
}

TEST_P(Signals, WarmupEndsItsChildAndTakesItsFolderAway) {
  setenv("TMPDIR", folder_.path().c_str(), 1);
  Process warmup({NAVJIT_COMMAND, "warmup", detector, "--seconds", "600", "--prime", "600",
                  "--report", log_.file("report.json")},
                 log_.file("log"));
  unsetenv("TMPDIR");
  ASSERT_TRUE(eventually([&] { return has_child(warmup.pid()); })) << warmup.text();
  EXPECT_EQ(files_in(folder_.path()).size(), 1U);
  const pid_t child = child_of(warmup.pid());
  ASSERT_NE(child, 0);
  warmup.send(number_);
  EXPECT_EQ(warmup.wait(), 128 + number_) << warmup.text();
  EXPECT_TRUE(files_in(folder_.path()).empty());
  EXPECT_NE(kill(child, 0), 0) << "the child goes on";
  EXPECT_EQ(files_in(log_.path()), std::vector<std::string>{"log"});
}

TEST_P(Signals, WarmupWritesTheRunsThatAreComplete) {
  Process warmup(
      {NAVJIT_COMMAND, "warmup", detector, "--seconds", "0.2", "--repetitions", "1000", "--modes",
       "cold", "--report", folder_.file("report.json"), "--csv", folder_.file("points.csv")},
      log_.file("log"));
  // The third child is the second of the runs without the JIT.
  std::set<pid_t> children;
  ASSERT_TRUE(eventually([&] {
    if (const pid_t child = child_of(warmup.pid())) children.insert(child);
    return children.size() >= 3;
  })) << warmup.text();
  warmup.send(number_);
  EXPECT_EQ(warmup.wait(), 128 + number_) << warmup.text();
  EXPECT_EQ(files_in(folder_.path()), (std::vector<std::string>{"points.csv", "report.json"}));
  const auto report = nlohmann::json::parse(read_file(folder_.file("report.json")));
  EXPECT_TRUE(report.at("interrupted"));
  ASSERT_EQ(report.at("variants").size(), 2U);
  const std::size_t off = report["variants"][0].at("runs").size();
  EXPECT_GE(off, 1U);
  EXPECT_LT(off, 1000U);
  const std::string points = read_file(folder_.file("points.csv"));
  EXPECT_NE(points.find("\noff,0,"), std::string::npos) << points;
  EXPECT_NE(warmup.text().find("| off |"), std::string::npos) << warmup.text();
}

TEST(Signals, WarmupThatLosesARunWritesTheOthers) {
  const TemporaryFolder folder, log;
  Process warmup({NAVJIT_COMMAND, "warmup", detector, "--seconds", "1", "--repetitions", "1000",
                  "--modes", "cold", "--report", folder.file("report.json"), "--csv",
                  folder.file("points.csv"), "--html", folder.file("page.html")},
                 log.file("log"));
  std::set<pid_t> children;
  pid_t last = 0;
  ASSERT_TRUE(eventually([&] {
    if (const pid_t child = child_of(warmup.pid()); child != 0 && children.insert(child).second) {
      last = child;
    }
    return children.size() >= 3;
  })) << warmup.text();
  kill(last, SIGKILL);
  EXPECT_EQ(warmup.wait(), 1) << warmup.text();
  EXPECT_EQ(files_in(folder.path()),
            (std::vector<std::string>{"page.html", "points.csv", "report.json"}));
  const auto report = nlohmann::json::parse(read_file(folder.file("report.json")));
  EXPECT_FALSE(report.at("interrupted"));
  EXPECT_GE(report.at("variants").at(0).at("runs").size(), 1U);
  const std::string failure = report.at("failure");
  EXPECT_TRUE(failure.starts_with("run ")) << failure;
  EXPECT_TRUE(failure.ends_with("': crashes (signal 9)")) << failure;
  EXPECT_NE(warmup.text().find("| off |"), std::string::npos) << warmup.text();
  EXPECT_NE(warmup.text().find("navjit: " + failure), std::string::npos) << warmup.text();
}

TEST_P(Signals, AccuracyWritesTheRaysThatAreJudged) {
  Process accuracy({NAVJIT_COMMAND, "-v", "accuracy", detector, "--rays", "1e6", "--threads", "2",
                    "--vecgeom", "off", "--report", folder_.file("report.json")},
                   log_.file("log"));
  ASSERT_TRUE(accuracy.says("event=judging")) << accuracy.text();
  const double begun = processor_seconds(accuracy.pid());
  ASSERT_TRUE(eventually([&] { return processor_seconds(accuracy.pid()) > begun + 1; }));
  accuracy.send(number_);
  EXPECT_EQ(accuracy.wait(), 128 + number_) << accuracy.text();
  const auto report = nlohmann::json::parse(read_file(folder_.file("report.json")));
  EXPECT_TRUE(report.at("interrupted"));
  const auto& generic = report.at("engines").at(0);
  EXPECT_GT(generic.at("rays"), 0);
  EXPECT_LT(generic.at("rays"), 1e6);
  EXPECT_GT(generic.at("steps"), generic.at("rays"));
  EXPECT_TRUE(generic.at("ns_per_step").is_null()) << "nothing was timed";
}

TEST_P(Signals, AccuracyEndsItsPeerAndWritesWhatItHas) {
  write_file(log_.file("peer"), "#!/bin/sh\nexec sleep 600\n");
  fs::permissions(log_.file("peer"), fs::perms::owner_all);
  write_plates(log_.file("plates.gdml"));
  setenv("TMPDIR", folder_.path().c_str(), 1);
  Process accuracy(
      {NAVJIT_COMMAND, "accuracy", log_.file("plates.gdml"), "--rays", "5", "--repetitions", "1",
       "--boundaries", "0", "--vecgeom", log_.file("peer"), "--report", log_.file("report.json")},
      log_.file("log"));
  unsetenv("TMPDIR");
  ASSERT_TRUE(eventually([&] { return has_child(accuracy.pid()); })) << accuracy.text();
  accuracy.send(number_);
  EXPECT_EQ(accuracy.wait(), 128 + number_) << accuracy.text();
  EXPECT_TRUE(files_in(folder_.path()).empty());
  const auto report = nlohmann::json::parse(read_file(log_.file("report.json")));
  EXPECT_TRUE(report.at("interrupted"));
  ASSERT_EQ(report.at("engines").size(), 2U) << "without the peer";
  EXPECT_EQ(report["engines"][1].at("rays"), 5);
  EXPECT_GT(report["engines"][1].at("ns_per_step"), 0);
  EXPECT_NE(accuracy.text().find("| generic |"), std::string::npos) << accuracy.text();
}

TEST_P(Signals, CommandsThatHaveNothingYetEndAtOnce) {
  const std::string long_check = "--resolution=100000000";
  Process check({NAVJIT_COMMAND, "check", detector, long_check}, log_.file("log"));
  // Its handlers are there when the detector is read.
  ASSERT_TRUE(eventually([&] {
    std::ifstream in("/proc/" + std::to_string(check.pid()) + "/status");
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with("SigCgt:")) return (std::stoull(line.substr(7), nullptr, 16) & 1) != 0;
    }
    return false;
  }));
  check.send(number_);
  EXPECT_EQ(check.wait(), 128 + number_) << check.text();
}

TEST_P(Signals, AccuracyEndsAtOnceWhileItCompiles) {
  Process accuracy({NAVJIT_COMMAND, "-v", "accuracy", NAVJIT_DETECTORS_DIR "/barrel.gdml", "--rays",
                    "1000", "--report", folder_.file("a.json")},
                   log_.file("log"));
  const auto judges = [&] { return accuracy.text().find("event=judging") != std::string::npos; };
  ASSERT_TRUE(eventually([&] { return processor_seconds(accuracy.pid()) > 0.5; }));
  ASSERT_FALSE(judges()) << accuracy.text();
  accuracy.send(number_);
  EXPECT_EQ(accuracy.wait(), 128 + number_) << accuracy.text();
  EXPECT_FALSE(judges()) << "it went on compiling";
  EXPECT_EQ(files_in(folder_.path()), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Apps, Signals,
                         testing::Values(SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1, SIGUSR2),
                         [](const auto& parameter) {
                           return parameter.param == SIGINT    ? "INT"
                                  : parameter.param == SIGTERM ? "TERM"
                                  : parameter.param == SIGHUP  ? "HUP"
                                  : parameter.param == SIGXCPU ? "XCPU"
                                  : parameter.param == SIGUSR1 ? "USR1"
                                                               : "USR2";
                         });

TEST(Signals, TheSecondEndsAtOnceAndLeavesNoTemporaryFile) {
  if (tests::under_thread_sanitizer) GTEST_SKIP() << "it holds signals back while a call blocks";
  const TemporaryFolder folder, log;
  // Nobody reads: the writer is stuck in the middle of its work.
  const std::string pipe = log.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  Process trace(
      {NAVJIT_COMMAND, "trace", detector, "--rays", "1e12", "--jit", "off", "--out", pipe},
      log.file("log"));
  char some[1];
  ASSERT_TRUE(eventually([&] { return read(reader, some, 1) == 1; })) << trace.text();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  trace.send(SIGTERM);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  trace.send(SIGTERM);
  EXPECT_EQ(trace.wait(), 128 + SIGTERM) << trace.text();
  close(reader);
}

TEST(Signals, WhatWasIgnoredStaysIgnored) {
  const TemporaryFolder folder;
  Process trace({"/bin/sh", "-c",
                 "trap '' HUP; exec " NAVJIT_COMMAND " trace " + detector +
                     " --rays 1e12 --jit off --out " + folder.file("steps.csv")},
                folder.file("log"));
  ASSERT_TRUE(eventually([&] { return files_in(folder.path()).size() == 2; })) << trace.text();
  trace.send(SIGHUP);
  trace.send(SIGINT);
  EXPECT_EQ(trace.wait(), 128 + SIGINT) << trace.text();
}

}  // namespace
}  // namespace navjit::tests
