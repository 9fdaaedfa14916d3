// Names in files that are written: each is unique.
#include <gtest/gtest.h>

#include <unordered_set>

#include "geometry/gdml/write/xml_text.hpp"

namespace navjit::gdml {
namespace {

TEST(NameBook, TellsEqualNamesApart) {
  NameBook names;
  EXPECT_EQ(names.own("a"), "a");
  EXPECT_EQ(names.own("a_2"), "a_2");
  EXPECT_EQ(names.own("a"), "a_3");
  EXPECT_EQ(names.own("a_3"), "a_3_2");
  EXPECT_EQ(names.own("a"), "a_4");
  EXPECT_EQ(names.own(""), "nameless");
  EXPECT_EQ(names.own(""), "_2");
  EXPECT_EQ(names.own("nameless"), "nameless_3");
}

TEST(NameBook, TellsAMillionApartWithoutCountingFromTheFirst) {
  NameBook names;
  std::unordered_set<std::string> given;
  constexpr std::size_t count = 1'000'000;
  for (std::size_t i = 0; i < count; ++i) given.insert(names.own("corner"));
  EXPECT_EQ(given.size(), count);
}

}  // namespace
}  // namespace navjit::gdml
