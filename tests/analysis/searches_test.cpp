#include "analysis/searches.hpp"

#include <gtest/gtest.h>

#include <set>

namespace navjit {
namespace {

TEST(Searches, HaveNamesByWhichTheyAreFound) {
  std::set<std::string_view> names, structures;
  for (const SearchFacts& facts : all_searches) {
    EXPECT_EQ(search_named(facts.name), facts.search) << facts.name;
    EXPECT_TRUE(names.insert(facts.name).second) << facts.name;
    EXPECT_TRUE(structures.insert(facts.of_daughters).second) << facts.name;
    // A name begins no other one, and has no sign by which lists and overrides are divided.
    EXPECT_EQ(facts.name.find_first_of(" ,:=|\n"), std::string_view::npos) << facts.name;
    for (const SearchFacts& other : all_searches) {
      EXPECT_TRUE(&other == &facts || !other.name.starts_with(facts.name)) << facts.name;
    }
  }
  EXPECT_EQ(search_named("off"), std::nullopt);
  EXPECT_EQ(search_named(""), std::nullopt);
}

TEST(Searches, OfDataAloneAreNotListedForCode) {
  for (const SearchFacts& facts : all_searches) {
    EXPECT_FALSE(facts.for_data_alone && facts.listed_if_faster) << facts.name;
  }
}

}  // namespace
}  // namespace navjit
