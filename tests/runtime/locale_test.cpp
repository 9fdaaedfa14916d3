// In a program whose locale has a comma for the decimal point, as programs with windows may, what
// the library writes for itself and reads has points.
#include <gtest/gtest.h>

#include <clocale>
#include <cstdio>
#include <cstdlib>

#include "navjit/observation.hpp"
#include "navjit/runtime.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/traces.hpp"

namespace navjit {
namespace {

/// A German locale, made by the system's own tool; removed at the end.
class WithCommas {
 public:
  WithCommas() {
    const std::string make =
        "localedef -i de_DE -f UTF-8 " + folder_.file("de_DE.UTF-8") + " > /dev/null 2> /dev/null";
    if (std::system(make.c_str()) != 0) return;
    setenv("LOCPATH", folder_.path().c_str(), 1);
    there_ = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
  }
  WithCommas(const WithCommas&) = delete;
  WithCommas& operator=(const WithCommas&) = delete;
  ~WithCommas() {
    std::setlocale(LC_ALL, "C");
    unsetenv("LOCPATH");
  }
  bool there() const { return there_; }

 private:
  tests::TemporaryFolder folder_;
  bool there_ = false;
};

TEST(Locale, ACommaForThePointChangesNothing) {
  const WithCommas commas;
  if (!commas.there()) GTEST_SKIP() << "no localedef (Debian's package locales)";
  char text[8];
  std::snprintf(text, sizeof text, "%.1f", 0.5);
  ASSERT_STREQ(text, "0,5");

  const auto world = std::make_shared<const World>(tests::mixed_world());
  RuntimeOptions options = tests::eager_options(JitMode::wait);
  std::size_t warnings = 0;
  options.log = [&](LogLevel level, std::string_view) {
    warnings += level == LogLevel::warning ? 1 : 0;
  };
  Runtime runtime(world, options);
  EXPECT_EQ(tests::traces_that_differ(runtime, tests::rays_through(*world, 6, 200)), 0U);
  EXPECT_GE(tests::scenes_compiled(runtime), 3U);
  EXPECT_EQ(warnings, 0U);

  const std::string budget = observation_text(parse_observation("budget:0.5"));
  EXPECT_EQ(budget, "budget:0.5");
  EXPECT_EQ(parse_observation(budget).budget, 0.5);
}

}  // namespace
}  // namespace navjit
