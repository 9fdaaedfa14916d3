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
  for (const char* text :
       {"", "auto", "linear:surface", "two-level:", "two_level", "two-level:k", ":", "tree"}) {
    EXPECT_FALSE(parse_structure(text)) << text;
  }
}

TEST(Structure, FewBoxesAreScannedAndManyAreNot) {
  for (const std::size_t count : {0, 1, 8}) {
    EXPECT_EQ(default_method(count).method, Method::linear);
  }
  bool scanned = true;
  for (std::size_t count = 0; count < 20000; ++count) {
    const bool linear = default_method(count).method == Method::linear;
    EXPECT_TRUE(scanned || !linear) << count;
    scanned = linear;
  }
  EXPECT_FALSE(scanned);
}

}  // namespace
}  // namespace navjit::bvh
