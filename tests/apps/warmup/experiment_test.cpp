// What the warm-up experiment asks of its processes.
#include "apps/warmup/experiment.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "apps/warmup/one_run_options.hpp"

namespace navjit::warmup {
namespace {

/// Whether these words follow one another in a command line.
bool has(const std::vector<std::string>& line, const std::vector<std::string>& words) {
  return std::search(line.begin(), line.end(), words.begin(), words.end()) != line.end();
}

TEST(SpecialiseWords, MakeAPluginOfTheCodeThatRunsMake) {
  RunSetup setup;
  CLI::App app;
  const std::vector<CLI::Option*> shared = add_shared_options(app, setup);
  app.parse("det.gdml --setup inner --isa avx2 --eta 1,2 --threads 2 --interval 0.1");
  ExperimentOptions options;
  options.program = "navjit";
  options.plugin_words = words_given(options_of_plugins(shared));
  const std::vector<std::string> line =
      specialise_words(options, {"plugin -O1", Mode::plugin, {"--opt", "1"}}, "p.json", "p.so");
  ASSERT_GE(line.size(), 2U);
  EXPECT_EQ(line[1], "specialise");
  EXPECT_TRUE(has(line, {"det.gdml"}));
  EXPECT_TRUE(has(line, {"--setup", "inner"}));
  EXPECT_TRUE(has(line, {"--isa", "avx2"}));
  EXPECT_TRUE(has(line, {"--opt", "1"}));
  EXPECT_TRUE(has(line, {"--profile", "p.json"}));
  EXPECT_TRUE(has(line, {"-o", "p.so"}));
  for (const char* of_runs : {"--eta", "--threads", "--interval"}) {
    EXPECT_FALSE(has(line, {of_runs})) << "specialise has no " << of_runs;
  }
}

}  // namespace
}  // namespace navjit::warmup
