// Options that make no sense are refused before anything is made from them.
#include "runtime/check_options.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>

#include "navjit/errors.hpp"
#include "navjit/runtime.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

TEST(CheckOptions, NumbersHaveToMakeSense) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::pair<const char*, std::function<void(RuntimeOptions&)>> wrong[] = {
      {"budget is -1", [](RuntimeOptions& o) { o.budget = -1; }},
      {"budget is nan", [&](RuntimeOptions& o) { o.budget = nan; }},
      {"budget is inf", [](RuntimeOptions& o) { o.budget = INFINITY; }},
      {"poll_ms is -5", [](RuntimeOptions& o) { o.specialiser.poll_ms = -5; }},
      {"poll_ms is nan", [&](RuntimeOptions& o) { o.specialiser.poll_ms = nan; }},
      {"compile_share is -0.5", [](RuntimeOptions& o) { o.specialiser.compile_share = -0.5; }},
      {"optimisation is 9", [](RuntimeOptions& o) { o.specialiser.optimisation = 9; }},
      {"boxes is 77", [](RuntimeOptions& o) { o.geometry.boxes = {bvh::Method{77}}; }},
      {"boxes_of is 9", [](RuntimeOptions& o) { o.geometry.boxes_of["a"].groups_per_cluster = 9; }},
      {"force is 77", [](RuntimeOptions& o) { o.geometry.force = GeometryOptions::Force{77}; }},
      {"jit is 77", [](RuntimeOptions& o) { o.jit = JitMode{77}; }},
      {"nice is 20", [](RuntimeOptions& o) { o.specialiser.nice = 20; }},
      {"nice is -1", [](RuntimeOptions& o) { o.specialiser.nice = -1; }},
      {"optimisation is -1", [](RuntimeOptions& o) { o.specialiser.optimisation = -1; }}};
  for (const auto& [words, change] : wrong) {
    RuntimeOptions options;
    options.jit = JitMode::off;
    change(options);
    try {
      const Runtime runtime(world, options);
      ADD_FAILURE() << words << " was taken";
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
  RuntimeOptions far;
  far.specialiser.poll_ms = INFINITY;  // hardly ever
  EXPECT_NO_THROW(checked(far));
}

TEST(CheckOptions, ARelativeCacheIsThatOfNow) {
  RuntimeOptions options;
  options.cache.directory = "some/cache";
  EXPECT_EQ(checked(options).cache.directory,
            (std::filesystem::current_path() / "some/cache").string());
  options.cache.directory.clear();
  EXPECT_EQ(checked(options).cache.directory, "");
}

}  // namespace
}  // namespace navjit
