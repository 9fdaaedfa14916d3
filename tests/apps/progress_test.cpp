// The progress line fits the terminal, and goes nowhere else.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/ioctl.h>

#include "tests/support/folder.hpp"
#include "tests/support/process.hpp"

namespace navjit::tests {
namespace {

const std::string detector = NAVJIT_DETECTORS_DIR "/shashlik.gdml";

class Progress : public testing::TestWithParam<unsigned short> {};

TEST_P(Progress, FitsTheTerminal) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0) {
    GTEST_SKIP() << "no terminals here";
  }
  const winsize size{24, GetParam(), 0, 0};
  ASSERT_EQ(ioctl(terminal, TIOCSWINSZ, &size), 0);
  const TemporaryFolder folder;
  const std::string name = ptsname(terminal);
  const int kept = open(name.c_str(), O_RDWR | O_NOCTTY);  // so that reading does not end early
  Process run({"/bin/sh", "-c",
               "exec " NAVJIT_COMMAND " run " + detector + " --rays 1e8 --jit off 2> " + name},
              folder.file("log"));
  std::string text;
  const auto lines = [&] {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find("\r\x1b[K", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  ASSERT_TRUE(eventually([&] {
    pollfd file{terminal, POLLIN, 0};
    char some[4096];
    if (poll(&file, 1, 0) > 0) {
      const ssize_t n = read(terminal, some, sizeof some);
      if (n > 0) text.append(some, static_cast<std::size_t>(n));
    }
    return lines() >= 4;
  })) << text;
  run.send(SIGTERM);
  EXPECT_EQ(run.wait(), 128 + SIGTERM);
  close(kept);
  close(terminal);
  std::size_t shown = 0;
  for (std::size_t at = 0; (at = text.find("\r\x1b[K", at)) != std::string::npos;) {
    at += 4;
    const std::size_t end = std::min(text.find('\r', at), text.size());
    EXPECT_LT(end - at, GetParam()) << text.substr(at, end - at);
    shown = std::max(shown, end - at);
    if (GetParam() >= 80 && end > at) {
      EXPECT_NE(text.substr(at, end - at).find("M steps/s"), std::string::npos) << text;
    }
  }
  EXPECT_GT(shown, 10U) << text;
}

INSTANTIATE_TEST_SUITE_P(Apps, Progress, testing::Values(40, 80, 200),
                         [](const auto& parameter) { return std::to_string(parameter.param); });

TEST(Progress, IsNotShownWhereQuietIsAskedFor) {
  const TemporaryFolder folder;
  // A terminal by script(1), where there is one.
  if (std::system("command -v script > /dev/null 2>&1") != 0) GTEST_SKIP() << "no script(1)";
  for (const std::string quiet : {"", "--quiet "}) {
    const std::string command = "timeout -s TERM 3 " NAVJIT_COMMAND " " + quiet + "run " +
                                detector + " --rays 1e8 --jit off --cache off > " +
                                folder.file("out");
    const std::string log = folder.file("log");
    std::system(
        ("script -q -e -c '" + command + "' " + log + " > /dev/null 2>&1 < /dev/null").c_str());
    const std::string text = read_file(log);
    EXPECT_EQ(text.find("% ") == std::string::npos && text.find("%, ") == std::string::npos,
              !quiet.empty())
        << text;
  }
}

TEST(Progress, IsNotWrittenIntoFiles) {
  const TemporaryFolder folder;
  Process run({NAVJIT_COMMAND, "run", detector, "--rays", "1e8", "--jit", "off"},
              folder.file("log"));
  std::this_thread::sleep_for(std::chrono::seconds(4));
  run.send(SIGTERM);
  EXPECT_EQ(run.wait(), 128 + SIGTERM);
  EXPECT_EQ(run.text().find(" of 100000000 rays"), std::string::npos) << run.text();
}

}  // namespace
}  // namespace navjit::tests
