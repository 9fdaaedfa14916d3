#include "runtime/log_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace navjit {
namespace {

TEST(LogText, LinesBecomeOne) {
  EXPECT_EQ(one_line("a.cpp:1: error\n  x\n  ^\n"), "a.cpp:1: error |   x |   ^");
  EXPECT_EQ(one_line(""), "");
  EXPECT_EQ(one_line("a\tb\x1b[31m"), "a?b?[31m");
  EXPECT_EQ(in_quotes("say \"x\\y\""), "\"say \\\"x\\\\y\\\"\"");
}

TEST(LogText, NothingBreaksTheLineOrItsLength) {
  std::mt19937_64 random(1);
  for (int n = 0; n < 2000; ++n) {
    std::string text(random() % 400, ' ');
    for (char& c : text) c = static_cast<char>(random());
    const std::string line = one_line(text, 100);
    EXPECT_LE(line.size(), 106U);
    EXPECT_TRUE(std::none_of(line.begin(), line.end(), [](char c) {
      return static_cast<unsigned char>(c) < ' ' || c == 0x7f;
    }));
    const std::string value = in_quotes(text, 100);
    for (std::size_t i = 1; i + 1 < value.size(); ++i) {  // quotes only after a backslash
      if (value[i] == '\\') {
        ++i;
      } else {
        EXPECT_NE(value[i], '"');
      }
    }
  }
}

}  // namespace
}  // namespace navjit
