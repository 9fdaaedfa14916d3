#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "jit/compiler.hpp"
#include "jit/linker.hpp"

namespace navjit::jit {
namespace {

/// Compiles, links and calls `rounds` different functions; counts the right results.
void work(Linker& linker, int first, int rounds, std::atomic<int>& right) {
  auto compiler = Compiler::create(CompileOptions{});
  if (!compiler) return;
  for (int i = first; i < first + rounds; ++i) {
    const auto object = compiler->compile(
        "extern \"C\" int f(int x) { return x + " + std::to_string(i) + "; }", "unit.cpp");
    if (!object) continue;
    const auto code = linker.link(*object);
    if (!code) continue;
    const auto f = code->function<int(int)>("f");
    if (f && (*f)(1000) == 1000 + i) ++right;
  }
}

TEST(Threads, CompileAndLinkWithALinkerEach) {
  std::atomic<int> right = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t) {
    threads.emplace_back([&right, t] {
      auto linker = Linker::create();
      if (linker) work(*linker, 100 * t, 20, right);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, 60);
}

TEST(Threads, ShareALinker) {
  auto linker = Linker::create();
  ASSERT_TRUE(linker);
  std::atomic<int> right = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t) {
    threads.emplace_back([&right, &linker, t] { work(*linker, 100 * t, 20, right); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, 60);
}

}  // namespace
}  // namespace navjit::jit
