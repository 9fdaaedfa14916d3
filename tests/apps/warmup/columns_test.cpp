// What tables tell of a variant's runs.
#include "apps/warmup/columns.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "apps/warmup/page.hpp"

namespace navjit::warmup {
namespace {

/// Five runs, of which one was ahead in the end; in one the JIT came too late for a speed-up.
VariantReport some_runs() {
  VariantReport report{{"cold", Mode::cold, {}}, std::vector<RunFigures>(5)};
  for (RunFigures& run : report.runs) run.speed_up = 0.5;
  report.runs[0].break_even_s = 0.01;
  report.runs[4].speed_up.reset();
  return report;
}

std::string field(const VariantReport& report, const std::string& heading) {
  const std::vector<std::string> all = headings();
  const auto at = std::find(all.begin(), all.end(), heading) - all.begin();
  return fields_of(report).at(static_cast<std::size_t>(at)).text;
}

TEST(Columns, SayHowManyRunsHaveAValue) {
  const VariantReport report = some_runs();
  ASSERT_EQ(fields_of(report).size(), headings().size());
  EXPECT_EQ(field(report, "break-even, s"), "0.01 (0.01 to 0.01), 1 of 5");
  EXPECT_EQ(field(report, "speed-up in the end"), "0.50 (0.50 to 0.50), 4 of 5");
  EXPECT_EQ(field(report, "90%, s"), "never");
}

TEST(Columns, HaveADashForWhatWasNotMeasured) {
  VariantReport report = some_runs();
  for (RunFigures& run : report.runs) run.speed_up.reset();
  EXPECT_EQ(field(report, "speed-up in the end"), "-");
  EXPECT_EQ(field({{"cold", Mode::cold, {}}, {}}, "break-even, s"), "-") << "it was not run";
  report.variant.mode = Mode::off;
  EXPECT_EQ(field(report, "speed-up in the end"), "1");
  EXPECT_EQ(field(report, "break-even, s"), "");
}

TEST(Columns, AreThoseOfThePage) {
  ExperimentReport report;
  report.variants = {some_runs()};
  EXPECT_NE(page(report, "title", {}).find("0.01 (0.01 to 0.01), 1 of 5"), std::string::npos);
}

}  // namespace
}  // namespace navjit::warmup
