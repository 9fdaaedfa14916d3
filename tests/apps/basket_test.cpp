// --basket on the command line.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"

namespace navjit {
namespace {

using nlohmann::json;
using tests::run_navjit;

const std::string detector = NAVJIT_DETECTORS_DIR "/barrel.gdml";

TEST(BasketOption, TracesAreThoseOfOneByOne) {
  const tests::TemporaryFolder folder;
  const auto trace = [&](const std::string& options) {
    const std::string out = folder.file("out.csv");
    const tests::Output output =
        run_navjit("trace " + detector + " --rays 400 --out " + out + options);
    EXPECT_EQ(output.status, 0) << output.text;
    return tests::read_file(out);
  };
  const std::string right = trace(" --jit off");
  EXPECT_GT(right.size(), 10000U);
  EXPECT_EQ(trace(" --basket 1"), right);
  EXPECT_EQ(trace(" --basket 37 --threads 2"), right);
  EXPECT_EQ(trace(" --basket 1e3 --jit shadow"), right);
  const std::string seen = trace(" --observe materials --jit off");
  EXPECT_LT(seen.size(), right.size());
  EXPECT_EQ(trace(" --observe materials --basket 1"), seen);
  EXPECT_EQ(trace(" --observe materials --basket 37 --threads 2"), seen);
  EXPECT_EQ(trace(" --observe mixtures:1% --basket 64"), trace(" --observe mixtures:1%"));
}

TEST(BasketOption, RunsComeToTheSameSums) {
  const tests::TemporaryFolder folder;
  const auto report = [&](const std::string& options) {
    const std::string path = folder.file("report.json");
    const tests::Output output =
        run_navjit("run " + detector + " --rays 1500 --jit off --report " + path + options);
    EXPECT_EQ(output.status, 0) << output.text;
    return json::parse(tests::read_file(path));
  };
  const json one = report(""), many = report(" --basket 100");
  EXPECT_EQ(one["basket"], 0);
  EXPECT_EQ(many["basket"], 100);
  for (const char* sum : {"rays", "steps", "stuck", "length_mm"}) EXPECT_EQ(one[sum], many[sum]);
}

TEST(BasketOption, WrongOnesAreRefused) {
  for (const char* wrong : {"0", "-1", "1.5", "many", "1e7"}) {
    const tests::Output output =
        run_navjit("trace " + detector + " --rays 1 --basket " + std::string(wrong));
    EXPECT_EQ(output.status, 2) << output.text;
    EXPECT_NE(output.text.find("--basket"), std::string::npos) << output.text;
  }
}

}  // namespace
}  // namespace navjit
