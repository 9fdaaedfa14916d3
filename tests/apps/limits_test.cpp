// With little memory, few threads, few files or few bytes a command does its work, or says in one
// line why it does not; it neither hangs nor crashes.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <algorithm>

#include "tests/support/folder.hpp"
#include "tests/support/memory_limit.hpp"
#include "tests/support/plates.hpp"
#include "tests/support/process.hpp"
#include "tests/support/sanitizers.hpp"

namespace navjit::tests {
namespace {

constexpr auto npos = std::string::npos;
const std::string detector = NAVJIT_DETECTORS_DIR "/absorber.gdml";

/// FOLDER stands for a folder with a profile and a detector that compiles quickly.
const std::vector<std::string> commands{
    "--version",
    "inspect " + detector + " --scene World --emit",
    "run " + detector + " --rays 500 --threads 20 --report FOLDER/r --save-profile FOLDER/p",
    "run " + detector + " --rays 500 --jit wait",
    "trace " + detector + " --rays 500 --threads 20 --jit off --out FOLDER/t",
    "check " + detector + " --resolution 10",
    "accuracy FOLDER/plates.gdml --rays 5 --repetitions 1 --boundaries 0 --vecgeom off --threads "
    "20 "
    "--report FOLDER/a",
    "picture " + detector + " --size 300x200 --threads 20 -o FOLDER/i.png",
    "cache verify --cache FOLDER",
    "profile merge FOLDER/profile.json FOLDER/profile.json -o FOLDER/m",
    "specialise " + detector + " --profile FOLDER/profile.json --emit cpp -o FOLDER/s.cpp",
    "specialise " + detector + " --profile FOLDER/profile.json --emit so --opt 0 -o FOLDER/s.so",
    "warmup " + detector + " --seconds 0.05 --repetitions 1 --modes cold --csv FOLDER/w",
};

class Limits : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const Output output = run_navjit("run " + detector + " --rays 2000 --jit off --save-profile " +
                                     folder_.file("profile.json"));
    ASSERT_EQ(output.status, 0) << output.text;
    write_plates(folder_.file("plates.gdml"));
  }

  TemporaryFolder folder_;
};

/// The number of lines that are navjit's errors, and not those of the log or of a linker.
std::size_t errors_in(const std::string& text) {
  std::size_t count = text.starts_with("navjit: ") ? 1 : 0;
  for (std::size_t at = 0; (at = text.find("\nnavjit: ", at)) != npos; ++at) ++count;
  return count;
}

TEST_P(Limits, NoCommandHangsOrCrashes) {
  const std::string limit = GetParam();
  // Sanitizers need address space by the terabyte, and files of their own to look at memory.
  const bool theirs = limit.find("-v") != npos || limit == "ulimit -n 5";
  if (theirs && !tests::memory_can_be_limited) GTEST_SKIP() << "a sanitizer needs more itself";
  // Under it every command died of SIGXFSZ where no file may be written, threads of small stacks.
  const bool of_threads = limit.find("-s") != npos || limit.find("-f") != npos;
  if (of_threads && tests::under_thread_sanitizer) GTEST_SKIP() << "the sanitizer needs more";
  for (std::string command : commands) {
    for (std::size_t at; (at = command.find("FOLDER")) != npos;) {
      command.replace(at, 6, folder_.path());
    }
    const Output output =
        run_command("(" + limit + "; timeout 100 " NAVJIT_COMMAND " " + command, ")");
    EXPECT_TRUE(output.status == 0 || output.status == 1)
        << limit << ": " << command << ": " << output.status << ": " << output.text;
    EXPECT_EQ(errors_in(output.text), static_cast<std::size_t>(output.status))
        << limit << ": " << command << ": " << output.text;
  }
}

INSTANTIATE_TEST_SUITE_P(Apps, Limits,
                         testing::Values("ulimit -v 500000", "ulimit -v 300000", "ulimit -s 200",
                                         "ulimit -n 12", "ulimit -n 5", "ulimit -f 0",
                                         "ulimit -f 1"),
                         [](const auto& parameter) {
                           std::string name = parameter.param.substr(8);
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

TEST(Limits, TooManyThreadsAreNamed) {
  // As somebody who may have no second thread: nobody.
  const TemporaryFolder folder;
  for (const std::string command : {"trace", "run", "accuracy --vecgeom off --boundaries 0"}) {
    const std::string line = command + " " + detector + " --rays 500 --threads 8";
    const Output output = run_command(
        "prlimit --nproc=1 setpriv --reuid=65534 --regid=65534 --clear-groups " NAVJIT_COMMAND,
        line);
    if (output.text.find("setpriv:") != npos || output.text.find("prlimit:") != npos) {
      GTEST_SKIP() << output.text;
    }
    EXPECT_EQ(output.status, 1) << output.text;
    EXPECT_NE(output.text.find("only 1 of 8 threads could be started"), npos) << output.text;
    EXPECT_NE(output.text.find("fewer --threads"), npos) << output.text;
  }
}

TEST(Limits, AFullDiskLosesNothingThatWasThere) {
  const TemporaryFolder folder, elsewhere;
  const std::string& disk = folder.path();
  const std::string plates = elsewhere.file("plates.gdml");
  write_plates(plates);
  const std::string log = ::testing::TempDir() + "/full_disk_log";
  const int status = in_child([&] {
    if (unshare(CLONE_NEWNS) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return 77;
    mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr);
    if (mount("none", disk.c_str(), "tmpfs", 0, "size=64k,mode=0700") != 0) return 77;
    write_file(disk + "/before", "before");
    write_file(disk + "/filling", std::string(100000, 'x'));
    for (const std::string& command :
         {"run " + detector + " --rays 500 --jit off --report " + disk + "/before",
          "run " + detector + " --rays 500 --jit off --save-profile " + disk + "/before",
          "trace " + detector + " --rays 500 --jit off --out " + disk + "/before",
          "accuracy " + plates +
              " --rays 5 --repetitions 1 --boundaries 0 --vecgeom off --report " + disk + "/before",
          "specialise " + detector + " --scene Core --emit cpp -o " + disk + "/before"}) {
      const Output output = run_navjit(command);
      write_file(log, command + ": " + output.text);
      if (output.status != 1) return 1;
      if (output.text.find("No space left on device") == npos) return 2;
      if (read_file(disk + "/before") != "before") return 3;
      if (std::distance(std::filesystem::directory_iterator(disk),
                        std::filesystem::directory_iterator()) != 2) {
        return 4;
      }
    }
    return 0;
  });
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "no file system can be mounted here";
  EXPECT_EQ(status, 0) << read_file(log);
}

}  // namespace
}  // namespace navjit::tests
