#include "common/ordered_chunks.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <stdexcept>
#include <thread>

#include "common/parallel.hpp"

namespace navjit::common {
namespace {

using Chunks = OrderedChunks<int, int>;

/// Pieces 0, 1, ... count - 1.
std::function<std::optional<int>()> numbers(int count) {
  return
      [next = 0, count]() mutable { return next < count ? std::optional(next++) : std::nullopt; };
}

TEST(OrderedChunks, ResultsComeInOrderAndFewAreKept) {
  constexpr std::uint64_t window = 5;
  std::vector<int> used;
  std::atomic<int> under_way{0}, most{0};
  Chunks chunks(window, numbers(2000), [&](int&& result) {
    used.push_back(result);
    --under_way;
  });
  std::atomic<bool> stop{false};
  std::atomic<unsigned> seed{1};
  in_parallel(4, stop, [&] {
    std::mt19937 random(seed++);
    while (const auto piece = chunks.take()) {
      const int now = ++under_way;
      for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
      }
      if (random() % 8 == 0) std::this_thread::yield();
      chunks.give(piece->number, 2 * piece->work);
    }
  });
  ASSERT_EQ(used.size(), 2000U);
  for (int i = 0; i < 2000; ++i) ASSERT_EQ(used[static_cast<std::size_t>(i)], 2 * i);
  EXPECT_LE(most, static_cast<int>(window));
}

TEST(OrderedChunks, NothingIsUsedAfterAPieceThatIsNotComplete) {
  std::vector<int> used;
  Chunks chunks(4, numbers(10), [&](int&& result) { used.push_back(result); });
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(chunks.take());
  chunks.give(2, 2);
  chunks.give(1, 1, false);
  EXPECT_TRUE(used.empty());
  chunks.give(0, 0);
  chunks.give(3, 3);
  EXPECT_EQ(used, (std::vector{0, 1}));
  EXPECT_FALSE(chunks.take());
}

TEST(OrderedChunks, WhoWaitsIsWokenAtTheEnd) {
  Chunks chunks(1, numbers(10), [](int&&) {});
  ASSERT_TRUE(chunks.take());
  std::jthread waiting([&] { EXPECT_FALSE(chunks.take()); });
  chunks.stop();
}

TEST(InParallel, ThrowsWhatAWorkerThrowsAfterAllHaveEnded) {
  std::atomic<bool> stop{false};
  std::atomic<int> started{0}, ended{0};
  EXPECT_THROW(in_parallel(4, stop,
                           [&] {
                             if (++started == 2) {
                               ++ended;
                               throw std::bad_alloc();
                             }
                             while (!stop) std::this_thread::yield();
                             ++ended;
                           }),
               std::bad_alloc);
  EXPECT_TRUE(stop);
  EXPECT_EQ(started, ended);
}

}  // namespace
}  // namespace navjit::common
