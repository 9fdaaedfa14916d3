// The daughter that holds a touchable is found, whatever the sizes of the daughters' trees.
#include "geometry/model/daughter_holding.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace navjit {
namespace {

struct Starts {
  TouchableId offset;
};

std::vector<Starts> daughters_of(const std::vector<TouchableId>& trees) {
  std::vector<Starts> daughters;
  TouchableId next = 1;
  for (const TouchableId tree : trees) {
    daughters.push_back({next});
    next += tree;
  }
  return daughters;
}

/// The same, found by a look at one daughter after the other.
std::size_t last_that_starts(const std::vector<Starts>& daughters, TouchableId below) {
  std::size_t found = 0;
  for (std::size_t k = 0; k < daughters.size(); ++k) {
    if (daughters[k].offset <= below) found = k;
  }
  return found;
}

TEST(DaughterHolding, IsTheLastThatStartsAtOrBefore) {
  std::mt19937_64 random(5);
  for (int world = 0; world < 3000; ++world) {
    const TouchableId largest = 1 + random() % (world % 3 == 0 ? 1 : 1000);
    std::vector<TouchableId> trees(1 + random() % 40);
    // Some have one of far more than all others.
    for (TouchableId& tree : trees) {
      tree = random() % 20 == 0 ? 1'000'000 : 1 + random() % largest;
    }
    const std::vector<Starts> daughters = daughters_of(trees);
    for (const Starts& d : daughters) {
      for (const TouchableId below : {d.offset - 1, d.offset, d.offset + 1}) {
        if (below == 0) continue;
        ASSERT_EQ(daughter_holding(daughters, below), last_that_starts(daughters, below));
      }
    }
    const TouchableId anywhere = 1 + random() % (2 * daughters.back().offset);
    ASSERT_EQ(daughter_holding(daughters, anywhere), last_that_starts(daughters, anywhere));
  }
}

TEST(DaughterHolding, TreesOfOneSizeMayBeOfAnySize) {
  for (const TouchableId tree :
       {TouchableId{1}, TouchableId{7}, TouchableId{1} << 40, (TouchableId{1} << 58) / 9}) {
    const std::vector<Starts> daughters = daughters_of(std::vector<TouchableId>(9, tree));
    for (std::size_t k = 0; k < 9; ++k) {
      EXPECT_EQ(daughter_holding(daughters, daughters[k].offset), k);
      EXPECT_EQ(daughter_holding(daughters, daughters[k].offset + tree - 1), k);
    }
  }
}

/// Counts how often a daughter is looked at.
struct Counting {
  const std::vector<Starts>& all;
  mutable int looks = 0;
  std::size_t size() const { return all.size(); }
  const Starts& operator[](std::size_t k) const { return ++looks, all[k]; }
  auto begin() const { return looks += 100, all.begin(); }  // of a binary search
};

TEST(DaughterHolding, TreesOfOneSizeAreNotSearched) {
  const std::vector<Starts> daughters = daughters_of(std::vector<TouchableId>(10'000, 13));
  const double per_touchable = daughters_per_touchable(daughters);
  for (TouchableId below = 1; below < 13 * 10'000; below += 11) {
    const Counting counting{daughters};
    ASSERT_EQ(daughter_holding(counting, below, per_touchable), (below - 1) / 13);
    ASSERT_LE(counting.looks, 2);
  }
}

}  // namespace
}  // namespace navjit
