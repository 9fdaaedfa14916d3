// `navjit cache`, and runs that share a cache, die while they write it, or find damage in it.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"

namespace navjit {
namespace {

namespace fs = std::filesystem;
using tests::run_navjit;
using tests::TemporaryFolder;

const std::string absorber = NAVJIT_DETECTORS_DIR "/absorber.gdml";

std::string trace(const TemporaryFolder& folder, const std::string& options) {
  const std::string out = folder.file("steps.csv");
  const tests::Output output =
      run_navjit("trace " + absorber + " --opt 0 --rays 200 --seed 3 --out " + out + " " + options);
  EXPECT_EQ(output.status, 0) << output.text;
  return tests::read_file(out);
}

TEST(CacheCommand, ListsVerifiesAndClears) {
  const TemporaryFolder folder;
  const std::string cache = " --cache " + folder.file("cache");
  EXPECT_EQ(run_navjit("cache path" + cache).text, folder.file("cache") + "\n");
  EXPECT_EQ(run_navjit("cache list" + cache).status, 0) << "there is none yet";
  EXPECT_FALSE(fs::exists(folder.file("cache")));
  trace(folder, "--jit wait" + cache);
  const tests::Output list = run_navjit("cache list" + cache);
  EXPECT_EQ(list.status, 0);
  EXPECT_NE(list.text.find("scenes: "), std::string::npos) << list.text;
  EXPECT_EQ(run_navjit("cache verify" + cache).status, 0);
  const fs::path entry = *fs::directory_iterator(folder.file("cache"));
  fs::resize_file(entry, fs::file_size(entry) - 1);
  const tests::Output verify = run_navjit("cache verify" + cache);
  EXPECT_EQ(verify.status, 1);
  EXPECT_NE(verify.text.find("rejected: truncated"), std::string::npos) << verify.text;
  EXPECT_EQ(run_navjit("cache clear" + cache).status, 0);
  EXPECT_TRUE(fs::is_empty(folder.file("cache")));
}

TEST(CacheCommand, SaysWhyADirectoryIsRefused) {
  const TemporaryFolder folder;
  ASSERT_EQ(chmod(folder.path().c_str(), 0777), 0);
  for (const char* action : {"list", "verify", "clear"}) {
    const tests::Output output =
        run_navjit(std::string("cache ") + action + " --cache " + folder.path());
    EXPECT_EQ(output.status, 1);
    EXPECT_NE(output.text.find(folder.path() + " can be written by others"), std::string::npos);
    EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1);
  }
  for (const char* wrong : {"cache", "cache fly", "cache list more", "cache list --cache"}) {
    EXPECT_EQ(run_navjit(wrong).status, 2) << wrong;
  }
}

TEST(CachedRuns, ReportWhatCameFromTheCache) {
  const TemporaryFolder folder;
  nlohmann::json reports[2];
  for (nlohmann::json& report : reports) {
    const tests::Output output =
        run_navjit("run " + absorber + " --opt 0 --rays 500 --jit wait --cache " +
                   folder.file("cache") + " --report " + folder.file("report.json"));
    ASSERT_EQ(output.status, 0) << output.text;
    report = nlohmann::json::parse(tests::read_file(folder.file("report.json")));
  }
  EXPECT_EQ(reports[0].at("cached_modules"), 0);
  EXPECT_GT(reports[1].at("cached_modules"), 0);
  EXPECT_EQ(reports[1].at("cached_modules"), reports[1].at("modules"));
  EXPECT_EQ(reports[0].at("length_mm"), reports[1].at("length_mm"));
}

TEST(CachedRuns, TraceTheSameWhateverTheCacheHolds) {
  const TemporaryFolder folder;
  const std::string right = trace(folder, "--jit off");
  for (const std::string jit : {"wait", "on", "shadow", "wait", "on"}) {
    EXPECT_TRUE(trace(folder, "--jit " + jit + " --cache " + folder.file("cache")) == right) << jit;
  }
  for (const auto& entry : fs::directory_iterator(folder.file("cache"))) {
    tests::write_file(entry.path(), "damaged");
  }
  EXPECT_TRUE(trace(folder, "--jit wait --cache " + folder.file("cache")) == right);
  EXPECT_TRUE(trace(folder, "--jit wait --cache /proc/nothing") == right);
  EXPECT_TRUE(trace(folder, "--jit wait --cache off") == right);
}

TEST(CachedRuns, MayBeKilledAtAnyMoment) {
  const TemporaryFolder folder;
  std::mt19937_64 random(5);
  for (int round = 0; round < 12; ++round) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(3);
      const std::string cache = folder.file("cache"), out = folder.file("killed.csv");
      execl(NAVJIT_COMMAND, "navjit", "trace", absorber.c_str(), "--opt", "0", "--rays", "50",
            "--jit", "wait", "--cache", cache.c_str(), "--out", out.c_str(), nullptr);
      _exit(3);
    }
    usleep(static_cast<useconds_t>(20000 + random() % 600000));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    if (!fs::exists(folder.file("cache"))) continue;
    const tests::Output verify = run_navjit("cache verify --cache " + folder.file("cache"));
    EXPECT_EQ(verify.status, 0) << verify.text;
  }
  EXPECT_TRUE(trace(folder, "--jit wait --cache " + folder.file("cache")) ==
              trace(folder, "--jit off"));
}

TEST(CachedRuns, ManyAtOnceAgree) {
  const TemporaryFolder folder;
  const std::string right = trace(folder, "--jit off");
  std::vector<pid_t> children;
  for (int n = 0; n < 16; ++n) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      const std::string cache = folder.file("cache"), out = folder.file(std::to_string(n) + ".csv");
      execl(NAVJIT_COMMAND, "navjit", "trace", absorber.c_str(), "--opt", "0", "--rays", "200",
            "--seed", "3", "--jit", n % 2 == 0 ? "wait" : "on", "--cache", cache.c_str(), "--out",
            out.c_str(), nullptr);
      _exit(3);
    }
    children.push_back(child);
  }
  for (std::size_t n = 0; n < children.size(); ++n) {
    int status = 0;
    ASSERT_EQ(waitpid(children[n], &status, 0), children[n]);
    EXPECT_EQ(status, 0);
    EXPECT_TRUE(tests::read_file(folder.file(std::to_string(n) + ".csv")) == right) << n;
  }
  EXPECT_EQ(run_navjit("cache verify --cache " + folder.file("cache")).status, 0);
}

}  // namespace
}  // namespace navjit
