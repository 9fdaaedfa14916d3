#include "geometry/solids/kinds.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "navjit/solids.hpp"

namespace navjit {
namespace {

TEST(Kinds, HaveNames) {
  EXPECT_STREQ(kind_name(make_orb("s", 1).kind), "orb");
  EXPECT_STREQ(kind_name(SolidKind::polyhedra), "polyhedra");
  EXPECT_STREQ(kind_name(SolidKind::subtraction_of), "subtraction");
}

TEST(Kinds, AreEachListedOnce) {
  std::set<int> kinds;
  std::set<std::string> names;
  for (const KindFacts& kind : all_kinds()) {
    kinds.insert(static_cast<int>(kind.kind));
    names.insert(kind.name);
    EXPECT_EQ(&facts_of(kind.kind), &kind) << kind.name;
  }
  EXPECT_EQ(names.size(), all_kinds().size());
  EXPECT_EQ(kinds.size(), all_kinds().size());
  EXPECT_EQ(*kinds.rbegin() + 1, static_cast<int>(kinds.size())) << "one is not listed";
}

TEST(Kinds, KnowTheirShapesAndKernels) {
  const KindFacts& cut_tube = facts_of(SolidKind::cut_tube);
  EXPECT_STREQ(cut_tube.shape, "CutTube<double>");
  EXPECT_STREQ(cut_tube.kernel_files.back(), "cuttube");
  EXPECT_TRUE(cut_tube.elements.empty());
}

TEST(GdmlWords, SayWhatMakesASolid) {
  const KindFacts& orb = facts_of(SolidKind::orb);
  ASSERT_EQ(orb.elements.size(), 1U);
  const gdml::SolidElement& element = orb.elements[0];
  EXPECT_EQ(element.tag, "orb");
  ASSERT_EQ(element.count, 1U);
  EXPECT_STREQ(element.attributes[0].name, "r");
  const Solid made = element.make("ball", {7});
  EXPECT_EQ(made.kind, SolidKind::orb);
  EXPECT_EQ(made.name, "ball");
  EXPECT_EQ(made.extent.max.z, 7);
}

}  // namespace
}  // namespace navjit
