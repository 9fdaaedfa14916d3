#include "geometry/bvh/structure.hpp"

#include <gtest/gtest.h>

#include "tests/geometry/bvh/oracle.hpp"

namespace navjit::bvh {
namespace {

TEST(Structure, NamesAreReadBack) {
  for (const Structure& structure : test::structures()) {
    EXPECT_EQ(parse_structure(to_string(structure)), structure);
  }
  EXPECT_EQ(parse_structure("regular-tree"), Structure{Method::regular_tree});
  for (const char* text : {"", "auto", "linear:surface", "two-level:", "two_level", "two-level:k",
                           ":", "tree", "wide-tree:surface"}) {
    EXPECT_FALSE(parse_structure(text)) << text;
  }
}

TEST(Structure, OnlyTwoGroupsAreScanned) {
  for (std::size_t count = 0; count < 20000; ++count) {
    const bool two_groups = count > group_width && count <= 2 * group_width;
    EXPECT_EQ(default_method(count).method, two_groups ? Method::linear : Method::wide_tree)
        << count;
  }
}

}  // namespace
}  // namespace navjit::bvh
