// Budgets on the command line.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"

namespace navjit::tests {
namespace {

constexpr auto npos = std::string::npos;
const std::string detector = std::string(NAVJIT_DETECTORS_DIR) + "/shashlik.gdml";

TEST(BudgetCommand, SaysOfEverySceneWhetherItKeepsTheBudget) {
  const std::string file =
      (std::filesystem::path(::testing::TempDir()) / "navjit_budget.json").string();
  const Output output = run_navjit("run " + detector +
                                   " --rays 3000 --origin 0,0,0 --eta 2,5 --jit off --cache off "
                                   "--budget 1e-6 --report " +
                                   file);
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("budget 1e-06 mm: promised in "), npos) << output.text;
  const auto report = nlohmann::json::parse(read_file(file));
  std::filesystem::remove(file);
  EXPECT_EQ(report.at("budget_mm"), 1e-6);
  int promised = 0, without_bound = 0;
  for (const auto& scene : report.at("scenes")) {
    const auto& budget = scene.at("budget");
    EXPECT_FALSE(budget.at("why").get<std::string>().empty());
    if (budget.at("promised").get<bool>()) {
      ++promised;
      EXPECT_LE(budget.at("bound_mm"), 1e-6);
      EXPECT_LE(budget.at("measured_mm"), budget.at("bound_mm"));
    } else {
      EXPECT_TRUE(budget.at("bound_mm").is_null());
      ++without_bound;
    }
  }
  EXPECT_GT(promised, 10);
  EXPECT_GT(without_bound, 0);  // those with the beam pipe, a cone
}

TEST(BudgetCommand, TakesBudgetsAboveZero) {
  EXPECT_EQ(run_navjit("run " + detector + " --budget 0").status, 2);
  EXPECT_EQ(run_navjit("run " + detector + " --budget much").status, 2);
}

TEST(TraceCommand, TracesAreThoseOfGenericNavigators) {
  const TemporaryFolder folder;
  const auto trace = [&](const std::string& jit) {
    const Output output = run_navjit("-v trace " + detector + " --rays 300 --opt 0 --cache off " +
                                     "--jit " + jit + " --out " + folder.file("trace.csv"));
    EXPECT_EQ(output.status, 0) << output.text;
    const bool installed = output.text.find("event=installed ") != npos ||
                           output.text.find("verdict=installed") != npos;
    EXPECT_EQ(installed, jit == "wait") << output.text;
    return read_file(folder.file("trace.csv"));
  };
  const std::string generic = trace("off");
  EXPECT_GT(generic.size(), 1000U);
  EXPECT_EQ(trace("wait"), generic);
}

TEST(BudgetCommand, InspectTellsTheBound) {
  const Output bounded = run_navjit("inspect " + detector + " --scene InnerLead");
  EXPECT_EQ(bounded.status, 0);
  EXPECT_NE(bounded.text.find(" mm: tolerance "), npos) << bounded.text;
  const Output none = run_navjit("inspect " + detector + " --scene Pipe");
  EXPECT_NE(none.text.find("no bound is known of surfaces of "), npos) << none.text;
}

}  // namespace
}  // namespace navjit::tests
