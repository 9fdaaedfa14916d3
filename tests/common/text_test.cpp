#include "common/text.hpp"

#include <gtest/gtest.h>

namespace navjit::common {
namespace {

TEST(Text, FieldsAreQuotedWhereTheyNeedIt) {
  EXPECT_EQ(csv_field("World"), "World");
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("a b;c"), "a b;c");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("say \"x\""), "\"say \"\"x\"\"\"");
  EXPECT_EQ(csv_field("a\nb"), "\"a\nb\"");
  EXPECT_EQ(csv_field("a\rb"), "\"a\rb\"");
}

TEST(Text, NothingSteersTheTerminal) {
  EXPECT_EQ(printable("Kalorimeter \u00e9\u4e2d"), "Kalorimeter \u00e9\u4e2d");
  EXPECT_EQ(printable("a\nb\tc\r"), "a\\nb\\tc\\r");
  EXPECT_EQ(printable("\x1b[2J"), "\\x1b[2J");
  EXPECT_EQ(printable("\x7f"), "\\x7f");
  EXPECT_EQ(printable("\u009b2J"), "\\u{9b}2J");  // CSI in one character
  EXPECT_EQ(printable("a\u202eb"), "a\\u{202e}b");
  EXPECT_EQ(printable("\xff\xc3"), "\\xff\\xc3");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // half of a surrogate pair
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
}

TEST(Text, IsFittedByColumnsNotBytes) {
  EXPECT_EQ(fitted("abc", 5), "abc  ");
  EXPECT_EQ(fitted("\u00e9\u00e9\u00e9", 5), "\u00e9\u00e9\u00e9  ");
  EXPECT_EQ(fitted("\u4e2d\u4e2d", 5), "\u4e2d\u4e2d ");
  EXPECT_EQ(fitted("e\u0301", 3), "e\u0301  ");
  EXPECT_EQ(fitted("0123456789", 8), "...56789");
  EXPECT_EQ(fitted("\u4e2d\u4e2d\u4e2d\u4e2d", 6), "...\u4e2d ");
  EXPECT_EQ(fitted("abcde\u0301", 4), "...e\u0301");
  for (const char* text :
       {"", "a", "\u4e2d\u4e2d\u4e2d", "\x1b\x1b\x1b\x1b", "e\u0301e\u0301e\u0301"}) {
    for (std::size_t width = 3; width < 12; ++width) {
      EXPECT_EQ(columns(fitted(text, width)), width) << text;
    }
  }
}

}  // namespace
}  // namespace navjit::common
