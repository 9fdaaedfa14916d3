// Lines go to the user's sink, and those of each Runtime to its own.
#include "navjit/log.hpp"

#include <gtest/gtest.h>

#include <mutex>
#include <string>
#include <vector>

#include "tests/support/traces.hpp"

namespace navjit {
namespace {

/// Keeps the lines that it is given; shared with the sink, which may outlive the test.
struct Lines {
  std::mutex mutex;
  std::vector<std::pair<LogLevel, std::string>> lines;

  std::size_t count(LogLevel level, const std::string& part) {
    const std::lock_guard lock(mutex);
    return static_cast<std::size_t>(
        std::count_if(lines.begin(), lines.end(), [&](const auto& line) {
          return line.first == level && line.second.find(part) != std::string::npos;
        }));
  }
};

RuntimeOptions with_sink(const std::shared_ptr<Lines>& lines) {
  RuntimeOptions options = tests::eager_options(JitMode::wait);
  options.log = [lines](LogLevel level, std::string_view line) {
    const std::lock_guard lock(lines->mutex);
    lines->lines.emplace_back(level, line);
  };
  return options;
}

TEST(Log, GoesToTheSinkOfItsRuntimeAndNowhereElse) {
  const auto good = std::make_shared<Lines>(), bad = std::make_shared<Lines>();
  FaultyOptions broken{with_sink(bad)};
  broken.faults = tests::edited([](std::string& source) { source += "\nint broken = ;\n"; });
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  {
    Runtime a(tests::mixed_world(), with_sink(good));
    FaultyRuntime b(tests::mixed_world(), broken);
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(good->count(LogLevel::debug, "event=installed"), 3U);
  EXPECT_EQ(good->count(LogLevel::warning, ""), 0U);
  EXPECT_EQ(bad->count(LogLevel::debug, "event=installed"), 0U);
  EXPECT_GT(bad->count(LogLevel::warning, "stays "), 3U);
  EXPECT_EQ(bad->count(LogLevel::warning, "\n"), 0U) << "lines have no end";
}

TEST(Log, TellsOfPlugins) {
  const auto lines = std::make_shared<Lines>();
  RuntimeOptions options = with_sink(lines);
  options.jit = JitMode::on;
  options.plugin = "/nowhere.so";
  Runtime runtime(tests::mixed_world(), options);
  EXPECT_EQ(lines->count(LogLevel::warning, "plugin not used"), 1U);
}

}  // namespace
}  // namespace navjit
