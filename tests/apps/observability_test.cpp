// What other tools and the log tell about specialised navigators.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/plates.hpp"

namespace navjit::tests {
namespace {

const std::string detector = std::string(NAVJIT_DETECTORS_DIR) + "/shashlik.gdml";

TEST(Observability, GdbStopsInASpecialisedNavigatorByName) {
  if (std::system("gdb --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no gdb";
  const Output output = run_command(
      "gdb -batch -nx -ex 'set debuginfod enabled off' -ex 'set breakpoint pending on' "
      "-ex 'break navjit_step_5_InnerLead' -ex run -ex 'bt 2' --args " NAVJIT_COMMAND,
      "trace " + detector + " --rays 50 --jit wait --opt 0 --cache off --out /dev/null");
  if (output.text.find("ptrace") != std::string::npos) GTEST_SKIP() << "gdb may not trace";
  EXPECT_NE(output.text.find("hit Breakpoint 1, 0x"), std::string::npos) << output.text;
  EXPECT_NE(output.text.find("in navjit_step_5_InnerLead ()"), std::string::npos) << output.text;
}

TEST(Observability, DecisionsAreLinesOfKeysAndValues) {
  // Few rays are enough, unless the machine has too much else to do: then more of them, until the
  // thread that decides had its turn.
  const TemporaryFolder folder;
  write_plates(folder.file("plates.gdml"));
  Output output{0, {}};
  for (int rays = 20000; rays <= 20'000'000; rays *= 10) {
    output = run_navjit("-v run " + folder.file("plates.gdml") + " --cache off --nice 0 --rays " +
                        std::to_string(rays));
    ASSERT_EQ(output.status, 0) << output.text;
    if (output.text.find("event=chosen") != std::string::npos) break;
  }
  const std::regex field(R"re( [a-z_]+=("([^"\\]|\\.)*"|[^ "]+))re");
  std::istringstream lines(output.text);
  std::size_t events = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(" event=");
    if (at == std::string::npos) continue;
    ++events;
    EXPECT_NE(line.find(" at_s="), std::string::npos) << line;
    EXPECT_EQ(std::regex_replace(line.substr(at), field, ""), "") << line;
  }
  EXPECT_GT(events, 0U) << output.text;
  // Which module is to be made is said before it is: also by a run that ends sooner.
  EXPECT_NE(output.text.find("event=chosen"), std::string::npos) << output.text;
}

}  // namespace
}  // namespace navjit::tests
