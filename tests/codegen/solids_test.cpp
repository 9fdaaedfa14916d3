#include "codegen/solids.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace navjit::codegen {
namespace {

const Solid box = make_box("box", 3, 4, 5), tube = make_tube("tube", 0, 1, 9, 0, 7);
const Solid pierced = make_subtraction("pierced", box, tube);

/// Boxes along a line.
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

}  // namespace
}  // namespace navjit::codegen
