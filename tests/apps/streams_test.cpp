// Standard output that is full, closed, or not read: never a success, nor more than one line.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/plates.hpp"
#include "tests/support/process.hpp"

namespace navjit::tests {
namespace {

const std::string detector = NAVJIT_DETECTORS_DIR "/absorber.gdml";

/// Arguments of navjit that print something and succeed; FOLDER stands for a folder with a profile
/// and a detector that compiles quickly.
const std::vector<std::string> printing{
    "--help",
    "--version",
    "run --help",
    "inspect " + detector,
    "inspect " + detector + " --scene World --emit",
    "run " + detector + " --rays 10 --jit off",
    "trace " + detector + " --rays 10 --jit off",
    "check " + detector + " --resolution 10",
    "accuracy FOLDER/plates.gdml --rays 5 --repetitions 1 --boundaries 0 --vecgeom off",
    "cache path --cache FOLDER",
    "cache list --cache FOLDER",
    "cache verify --cache FOLDER",
    "cache clear --cache FOLDER",
    "profile merge FOLDER/profile.json FOLDER/profile.json -o FOLDER/merged.json",
    "specialise " + detector + " --profile FOLDER/profile.json --emit cpp -o FOLDER/plugin.cpp",
    "picture " + detector + " --size 30x20 -o FOLDER/p.png",
    "scan " + detector + " --eta-bins 3 --phi-bins 4 --rays 1 --csv FOLDER/s.csv",
    "run " + detector + " --rays 10 --jit off --html FOLDER/r.html",
    "warmup-run " + detector + " --seconds 0.05 --jit off",
    "warmup " + detector + " --seconds 0.05 --repetitions 1 --modes cold",
};

class Streams : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const Output output = run_navjit("run " + detector + " --rays 2000 --jit off --save-profile " +
                                     folder_.file("profile.json"));
    ASSERT_EQ(output.status, 0) << output.text;
    write_plates(folder_.file("plates.gdml"));
    for (std::size_t at; (at = arguments_.find("FOLDER")) != std::string::npos;) {
      arguments_.replace(at, 6, folder_.path());
    }
  }

  TemporaryFolder folder_;
  std::string arguments_ = GetParam();
};

TEST_P(Streams, FullOrClosedOutputIsAFailureOfOneLine) {
  const std::string command = std::string(NAVJIT_COMMAND " ") + arguments_;
  const Output good = run_command("(" + command, ")");
  ASSERT_EQ(good.status, 0) << good.text;
  for (const char* out : {" > /dev/full", " >&-"}) {
    const Output output = run_command("(" + command + out, ")");
    EXPECT_EQ(output.status, 1) << out << ": " << output.text;
    EXPECT_EQ(output.text.find("navjit: standard output cannot be written"), 0U) << output.text;
    EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
  }
}

TEST_P(Streams, AReaderThatGoesIsAFailureOfOneLine) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  const std::string log = folder_.file("log");
  const std::string command =
      std::string(NAVJIT_COMMAND " ") + arguments_ + " >&" + std::to_string(ends[1]) + " 2>" + log;
  const int status = std::system(command.c_str());
  close(ends[1]);
  ASSERT_TRUE(WIFEXITED(status));
  const std::string text = read_file(log);
  EXPECT_EQ(WEXITSTATUS(status), 1) << text;
  EXPECT_EQ(text.find("navjit: standard output cannot be written"), 0U) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

TEST_P(Streams, ClosedStreamsAreNoFiles) {
  // What is opened first must not take the number of standard output or error.
  const Output output =
      run_command("(" NAVJIT_COMMAND " " + arguments_ + " <&- 2>&- > " + folder_.file("out"), ")");
  EXPECT_EQ(output.status, 0);
  EXPECT_EQ(output.text, "");
  EXPECT_GT(read_file(folder_.file("out")).size(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Apps, Streams, testing::ValuesIn(printing),
                         [](const auto& parameter) { return std::to_string(parameter.index); });

/// The most memory that a process has had so far, MB.
double peak_mb(pid_t pid) {
  std::ifstream in("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024;
  }
  return 0;
}

/// Reads so many more bytes from a pipe.
bool read_on(int pipe, std::size_t bytes) {
  std::vector<char> piece(1 << 16);
  while (bytes > 0) {
    const ssize_t n = read(pipe, piece.data(), std::min(piece.size(), bytes));
    if (n <= 0) return false;
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

TEST(Streams, TraceNeedsNoMoreMemoryForMoreRays) {
  const TemporaryFolder folder;
  const std::string out = folder.file("steps"), rays = folder.file("rays");
  ASSERT_EQ(mkfifo(out.c_str(), 0600), 0);
  ASSERT_EQ(mkfifo(rays.c_str(), 0600), 0);
  signal(SIGPIPE, SIG_IGN);
  // The address sanitizer would keep what is freed.
  setenv("ASAN_OPTIONS", "quarantine_size_mb=1", 1);
  for (const std::string source : {"1e12", "file"}) {
    const bool from_file = source == "file";
    Process trace({NAVJIT_COMMAND, "trace", NAVJIT_DETECTORS_DIR "/shashlik.gdml", "--rays",
                   from_file ? rays : source, "--threads", "2", "--jit", "off", "--out", out},
                  folder.file("log"));
    // Rays without an end, until nobody reads them any more.
    std::thread writer;
    if (from_file) {
      writer = std::thread([&] {
        std::ofstream file(rays);
        file << "x,y,z,dx,dy,dz\n";
        while (file << "0,0,0,0.1,0.2,1\n") {
        }
      });
    }
    const int pipe = open(out.c_str(), O_RDONLY);
    EXPECT_TRUE(read_on(pipe, 5 << 20)) << trace.text();
    const double early = peak_mb(trace.pid());
    EXPECT_TRUE(read_on(pipe, 60 << 20)) << trace.text();
    const double late = peak_mb(trace.pid());
    trace.send(SIGKILL);
    trace.wait();
    close(pipe);
    if (from_file) writer.join();
    EXPECT_GT(early, 0);
    EXPECT_LT(late, early + 12) << "60 MB of steps, in pieces (" << source << ")";
  }
}

TEST(Streams, AReportIsWrittenWhereTheTableIsNot) {
  const TemporaryFolder folder;
  const Output output =
      run_command("(" NAVJIT_COMMAND " run " + detector + " --rays 10 --jit off --report " +
                      folder.file("r.json") + " --save-profile " + folder.file("p.json"),
                  "> /dev/full)");
  EXPECT_EQ(output.status, 1) << output.text;
  EXPECT_NE(read_file(folder.file("r.json")).find("\"steps\""), std::string::npos);
  EXPECT_NE(read_file(folder.file("p.json")).find("\"volumes\""), std::string::npos);
}

}  // namespace
}  // namespace navjit::tests
