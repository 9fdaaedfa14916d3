// Totals of rays by which runs are compared.
#include "apps/warmup/blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace navjit::warmup {
namespace {

TEST(Blocks, FollowOneAnotherWithoutGaps) {
  std::uint64_t chunk = 0;
  for (std::size_t block = 0; block < 400; ++block) {
    const std::uint64_t size = chunks_in(block);
    EXPECT_LE(size, std::max<std::uint64_t>(1, chunk / 32)) << block;
    EXPECT_EQ(block_of(chunk), block);
    chunk += size;
    EXPECT_EQ(block_of(chunk - 1), block);
  }
  EXPECT_LT(block_of(std::uint64_t{1} << 35), most_blocks);
}

TEST(Blocks, DoNotDependOnTheOrder) {
  Blocks forwards, backwards;
  for (std::uint64_t i = 0; i < 200; ++i) forwards.add(i, i, 0.1 * static_cast<double>(i));
  for (std::uint64_t i = 200; i-- > 0;) backwards.add(i, i, 0.1 * static_cast<double>(i));
  EXPECT_GT(forwards.complete().size(), 64U);
  EXPECT_TRUE(forwards.complete() == backwards.complete());
}

TEST(Blocks, SeeTheLastBitOfALateRay) {
  Blocks one, other;
  for (std::uint64_t i = 0; i < 100000; ++i) {
    one.add(i, 3, 1.5);
    other.add(i, 3, i == 90000 ? 1.5 * (1 + 0x1p-52) : 1.5);
  }
  const std::vector<Block> a = one.complete(), b = other.complete();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i] == b[i], i != block_of(90000)) << i;
  }
}

TEST(Blocks, EndBeforeTheFirstThatIsIncomplete) {
  Blocks blocks;
  for (const std::uint64_t chunk : {0, 1, 3}) blocks.add(chunk, 0, 0);
  EXPECT_EQ(blocks.complete().size(), 2U) << "chunk 2 is missing";
}

}  // namespace
}  // namespace navjit::warmup
