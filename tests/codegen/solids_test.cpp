#include "codegen/solids.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace navjit::codegen {
namespace {

const Solid box = make_box("box", 3, 4, 5), tube = make_tube("tube", 0, 1, 9, 0, 7);
const Solid pierced = make_subtraction("pierced", box, tube);

/// A union of boxes along a line.
Solid row(int count) {
  Solid solid = box;
  for (int i = 1; i < count; ++i) {
    SolidFrame at;
    at.translation[0] = 7.0 * i;
    solid = make_union("row", solid, make_placed("at", box, at));
  }
  return solid;
}

TEST(Solids, CodeIsForThoseThatAreMadeOfSeveral) {
  EXPECT_TRUE(gains_from_code(pierced.any()));
  EXPECT_TRUE(gains_from_code(row(5).any()));
  EXPECT_FALSE(gains_from_code(box.any()));
  EXPECT_FALSE(gains_from_code(tube.any()));
}

TEST(Solids, EachHasItsFunctions) {
  const Solid three = row(3);
  const std::vector solids{pierced.any(), three.any()};
  for (const bool with_safety : {true, false}) {
    const SolidModule module = generate_solids(solids, 1e-9, with_safety);
    ASSERT_EQ(module.entries.size(), 2U);
    EXPECT_NE(module.entries[0].contains, module.entries[1].contains);
    for (const SolidEntry& e : module.entries) {
      for (const std::string& name : {e.contains, e.distance_to_in, e.distance_to_out}) {
        EXPECT_NE(module.source.find(" " + name + "("), std::string::npos) << name;
      }
      EXPECT_EQ(e.safety_to_in.empty(), !with_safety);
      EXPECT_EQ(e.safety_to_out.empty(), !with_safety);
      EXPECT_EQ(e.data, nullptr);
    }
  }
}

TEST(Solids, NumbersOfLargeOnesAreData) {
  const Solid three = row(3), thirty = row(30);
  const std::vector few{three.any()}, many{thirty.any()};
  EXPECT_EQ(generate_solids(few, 1e-9, false).entries[0].data, nullptr);
  const SolidModule module = generate_solids(many, 1e-9, false);
  EXPECT_NE(module.entries[0].data, nullptr);
  EXPECT_NE(module.owner, nullptr);
  EXPECT_EQ(module.source.find("constexpr Union"), std::string::npos);
}

/// A chain: each boolean holds the one before it.
Solid chain(int count, const Solid& piece) {
  Solid solid = box;
  for (int i = 1; i < count; ++i) {
    SolidFrame at;
    at.translation[1] = 3.0 * i;
    const Solid next = make_placed("at", piece, at);
    solid = i % 2 == 0 ? make_union("u", solid, next) : make_subtraction("s", solid, next);
  }
  return solid;
}

TEST(Solids, TypesThatOccurAgainCountOnce) {
  const SolidTypes two = types_in(pierced.any());
  EXPECT_EQ(two.composed, 1U);
  EXPECT_EQ(two.plain, 1U) << "boxes do not count";
  const SolidTypes twice =
      types_in(make_union("two", pierced, make_placed("p", pierced, {})).any());
  EXPECT_EQ(twice.composed, 2U);
  EXPECT_EQ(twice.plain, 1U);
  EXPECT_LT(types_in(row(64).any()).composed, 20U) << "balanced, and alike at each level";
  EXPECT_GE(types_in(chain(9, tube).any()).composed, 5U);
}

TEST(Solids, OperandsShareFunctionsWhereThereAreMany) {
  const auto shares = [](const Solid& solid) {
    const std::vector solids{solid.any()};
    const std::string source = generate_solids(solids, 1e-9, false).source;
    return source.find("SolidApart<Placed<double, Tube<double>>>") != std::string::npos ||
           source.find("SolidApart<Placed<double, Ellipsoid") != std::string::npos;
  };
  EXPECT_FALSE(shares(chain(4, tube)));
  EXPECT_FALSE(shares(chain(8, tube)));
  EXPECT_TRUE(shares(chain(9, tube)));
  EXPECT_TRUE(shares(chain(40, tube)));
}

}  // namespace
}  // namespace navjit::codegen
