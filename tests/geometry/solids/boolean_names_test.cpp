// Booleans have the name that they were given, however their operands are combined, and errors in
// them name it.
#include <gtest/gtest.h>

#include <limits>

#include "geometry/solids/solid.hpp"
#include "navjit/errors.hpp"

namespace navjit {
namespace {

/// Too long to be stored inside a string: once it is moved from, it is gone.
const std::string long_name = "the fourth support of the inner tracker's second layer";

Solid part(int i) {
  SolidFrame frame;
  frame.translation[0] = 0.1 * i;
  return make_placed("part", make_box("box", 1, 1, 1), frame);
}

using Maker = Solid (*)(std::string, const Solid&, const Solid&);

struct Case {
  const char* name;
  Maker make;
  SolidKind kind;
};
constexpr Case cases[] = {{"union", make_union, SolidKind::union_of},
                          {"intersection", make_intersection, SolidKind::intersection_of},
                          {"subtraction", make_subtraction, SolidKind::subtraction_of}};

class BooleanNames : public testing::TestWithParam<Case> {};

TEST_P(BooleanNames, AreKeptByChainsFromEitherSide) {
  const auto& [text, make, kind] = GetParam();
  Solid left = part(0), right = part(0);
  for (int i = 1; i < 18; ++i) {
    const std::string name = long_name + std::to_string(i);
    left = make(name, left, part(i));
    EXPECT_EQ(left.name, name);
    EXPECT_EQ(left.kind, kind);
    right = make(name, part(i), right);
    EXPECT_EQ(right.name, name);
    EXPECT_EQ(right.kind, kind);
  }
  const Solid both = make(long_name, left, right);
  EXPECT_EQ(both.name, long_name);
  EXPECT_EQ(make("", both, part(1)).name, "");
}

TEST_P(BooleanNames, AreKeptWithBooleansOfAllKindsAsOperands) {
  for (const Case& first : cases) {
    for (const Case& second : cases) {
      const Solid a = first.make("first", part(0), part(1));
      const Solid b = second.make("second", part(2), part(3));
      EXPECT_EQ(GetParam().make(long_name, a, b).name, long_name) << first.name << second.name;
      EXPECT_EQ(a.name, "first");
      EXPECT_EQ(b.name, "second");
    }
  }
}

TEST_P(BooleanNames, AreInWhatIsSaidOfOperandsThatDoNotMeet) {
  const Solid far = part(1000);
  Solid chain = part(0);
  for (int i = 1; i < 6; ++i) {
    chain = GetParam().make("operand", chain, part(i));
    try {
      make_intersection(long_name, chain, far);
      ADD_FAILURE() << "operands that do not meet are not refused";
    } catch (const GeometryError& error) {
      EXPECT_EQ(std::string(error.what()),
                "solid '" + long_name + "': the operands of the intersection do not meet");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, BooleanNames, testing::ValuesIn(cases),
                         [](const auto& of) { return std::string(of.param.name); });

TEST(PlacedNames, OfAFrameThatIsNoNumberIsTold) {
  SolidFrame frame;
  frame.translation[1] = std::numeric_limits<double>::quiet_NaN();
  try {
    make_placed(long_name, make_union("operand", part(0), part(1)), frame);
    ADD_FAILURE() << "a frame without numbers is not refused";
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("'" + long_name + "'"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace navjit
