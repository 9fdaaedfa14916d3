// The file to which a benchmark writes its figures.
#include "bench/json_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "navjit/errors.hpp"

namespace navjit::bench {
namespace {

namespace fs = std::filesystem;

TEST(JsonFile, ThatCannotBeWrittenIsRefusedAtTheBeginning) {
  const std::string nowhere = testing::TempDir() + "navjit_no_such_folder/x.json";
  try {
    const JsonFile file(nowhere);
    ADD_FAILURE() << "was opened";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(nowhere), std::string::npos) << error.what();
  }
}

TEST(JsonFile, HoldsTheFigures) {
  const std::string path = testing::TempDir() + "navjit_bench_figures.json";
  {
    JsonFile file(path);
    file.write({{"steps", 3}, {"ns_per_step", NAN}});
  }
  std::ifstream in(path);
  const nlohmann::json read = nlohmann::json::parse(in);
  EXPECT_EQ(read["steps"], 3);
  EXPECT_TRUE(read["ns_per_step"].is_null());
  fs::remove(path);
}

TEST(JsonFile, MayBeLeftOut) {
  JsonFile none("");
  EXPECT_NO_THROW(none.write({{"steps", 3}}));
}

}  // namespace
}  // namespace navjit::bench
