#include "common/numbers.hpp"

#include <gtest/gtest.h>

#include <string>

#include "navjit/errors.hpp"

namespace navjit::common {
namespace {

TEST(Numbers, CountsAreWholeAndDecimal) {
  EXPECT_EQ(parse_count("1"), 1U);
  EXPECT_EQ(parse_count("1000"), 1000U);
  EXPECT_EQ(parse_count("010"), 10U);  // not octal
  EXPECT_EQ(parse_count("1e6"), 1000000U);
  EXPECT_EQ(parse_count("1E+6"), 1000000U);
  EXPECT_EQ(parse_count("2.5e3"), 2500U);
  EXPECT_EQ(parse_count("1200e-2"), 12U);
  EXPECT_EQ(parse_count("7."), 7U);
  EXPECT_EQ(parse_count("1e15"), most_counted);
  EXPECT_EQ(parse_count("0e99999", 0), 0U);
  EXPECT_EQ(parse_count("18446744073709551615", 0, ~std::uint64_t{0}), ~std::uint64_t{0});
}

TEST(Numbers, WhatIsNoCountIsRefusedInWords) {
  const auto why = [](const char* text) -> std::string {
    try {
      return "taken as " + std::to_string(parse_count(text));
    } catch (const UsageError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(why("0"), "'0' is less than 1");
  EXPECT_EQ(why("-1"), "'-1' is negative");
  EXPECT_EQ(why("2.5"), "'2.5' is not a whole number");
  EXPECT_EQ(why("1e-3"), "'1e-3' is not a whole number");
  for (const char* text : {"18446744073709551615", "18446744073709551616", "1e16", "1e99999999999",
                           "99999999999999999999999999999999"}) {
    EXPECT_EQ(why(text), "'" + std::string(text) + "' is more than 1000000000000000");
  }
  for (const char* text : {"", "x", "1x", "0x10", "nan", "inf", "1e", "e6", ".", "1 ", " 1",
                           "1,000", "1e6.5", "+-1", "--1", "1.2.3"}) {
    EXPECT_EQ(why(text), "'" + std::string(text) + "' is not a whole number, such as 1000 or 1e6");
  }
}

TEST(Numbers, AreFiniteAndDecimal) {
  EXPECT_EQ(parse_number("1e-6"), 1e-6);
  EXPECT_EQ(parse_number("-3.5"), -3.5);
  EXPECT_EQ(parse_number("+2"), 2);
  for (const char* text : {"", "nan", "NaN", "inf", "-inf", "infinity", "0x10", "1e400", "1x", " 1",
                           "+", "+-1", "++1", "1,5"}) {
    EXPECT_THROW(parse_number(text), UsageError) << text;
  }
}

TEST(Numbers, TellNumbersFromFiles) {
  for (const char* text : {"1", "0", "-1", "1e6", "2.5", "+3", ".5", "1e"}) {
    EXPECT_TRUE(looks_like_number(text)) << text;
  }
  for (const char* text : {"", "rays.csv", "./100", "e6", "-", ".", "100.csv", "1x"}) {
    EXPECT_FALSE(looks_like_number(text)) << text;
  }
}

}  // namespace
}  // namespace navjit::common
