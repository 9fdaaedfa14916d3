// What tools and logs tell about specialised navigators.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "tests/support/command.hpp"

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
  const Output output = run_navjit("-v run " + detector +
                                   " --origin 0,0,0 --eta 2,5 --rays 12000 --cache off --nice 0");
  ASSERT_EQ(output.status, 0) << output.text;
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
  // Which module is to be made is said before it is: also by a run that ends sooner.
  EXPECT_GT(events, 0U) << output.text;
  EXPECT_NE(output.text.find("event=chosen"), std::string::npos) << output.text;
}

}  // namespace
}  // namespace navjit::tests
