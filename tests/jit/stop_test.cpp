// Compilations that are stopped before they are finished, and processes that end meanwhile.
#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <thread>

#include "jit/activity.hpp"
#include "jit/compiler.hpp"
#include "tests/support/memory_limit.hpp"

namespace navjit::jit {
namespace {

/// So many functions with loops that the compiler needs a while for them.
std::string long_source(int functions) {
  std::string source;
  for (int i = 0; i < functions; ++i) {
    const std::string n = std::to_string(i);
    source += "extern \"C\" double f" + n +
              "(const double* x, int n) {\n  double s = 0;\n"
              "  for (int i = 0; i < n; ++i) {\n"
              "    if (x[i] > " +
              n +
              ") s += x[i] * x[i] / (1 + s);\n"
              "    else if (x[i] < -s) s -= __builtin_sqrt(x[i] + " +
              n +
              ");\n"
              "    for (int j = 0; j < 7; ++j) s += x[(i + j) % n] * j;\n"
              "  }\n  return s;\n}\n";
  }
  return source;
}

TEST(Stop, WhatIsAskedToStopAtOnceFailsAsStopped) {
  auto compiler = Compiler::create({});
  ASSERT_TRUE(compiler);
  std::stop_source stop;
  stop.request_stop();
  const auto object = compiler->compile(long_source(2), "unit.cpp", stop.get_token());
  ASSERT_FALSE(object);
  EXPECT_TRUE(object.failure().stopped);
  EXPECT_FALSE(object.failure().exhausted);
}

TEST(Stop, WhatTakesTooLongIsGivenUp) {
  auto unbounded = Compiler::create({});
  ASSERT_TRUE(unbounded);
  const std::string source = long_source(200);
  const auto start = std::chrono::steady_clock::now();
  const auto whole = unbounded->compile(source, "unit.cpp");
  const auto took = std::chrono::steady_clock::now() - start;
  ASSERT_TRUE(whole) << whole.failure().message;
  CompileOptions options;
  options.most_ms = std::chrono::duration<double, std::milli>(took).count() / 20;
  auto compiler = Compiler::create(options);
  ASSERT_TRUE(compiler);
  const auto object = compiler->compile(source, "unit.cpp");
  ASSERT_FALSE(object);
  EXPECT_NE(object.failure().message.find("ms to compile"), std::string::npos);
  EXPECT_FALSE(object.failure().stopped) << "the run goes on";
  EXPECT_FALSE(object.failure().exhausted) << "the next may take less";
  options.most_ms = 1e9;
  auto patient = Compiler::create(options);
  ASSERT_TRUE(patient);
  const auto again = patient->compile(source, "unit.cpp");
  ASSERT_TRUE(again) << again.failure().message;
  EXPECT_EQ(again->bytes, whole->bytes);
}

TEST(Stop, MayComeAtAnyMomentAndSpoilsNothing) {
  auto compiler = Compiler::create({});
  ASSERT_TRUE(compiler);
  const std::string source = long_source(25);
  const auto start = std::chrono::steady_clock::now();
  const auto whole = compiler->compile(source, "unit.cpp");
  const auto took = std::chrono::steady_clock::now() - start;
  ASSERT_TRUE(whole) << whole.failure().message;
  std::mt19937 random(1);
  int stopped = 0;
  for (int i = 0; i < 30; ++i) {
    std::stop_source stop;
    const auto after = took * (random() % 1000) / 1000;
    std::jthread asks([&] {
      std::this_thread::sleep_for(after);
      stop.request_stop();
    });
    const auto object = compiler->compile(source, "unit.cpp", stop.get_token());
    if (object) {
      EXPECT_EQ(object->bytes, whole->bytes);
    } else {
      EXPECT_TRUE(object.failure().stopped) << object.failure().message;
      ++stopped;
    }
  }
  EXPECT_GT(stopped, 5);
  const auto again = compiler->compile(source, "unit.cpp");
  ASSERT_TRUE(again) << again.failure().message;
  EXPECT_EQ(again->bytes, whole->bytes);
}

/// Compiles with only so much more memory, and ends the process: with 0 if there is code, 1 if the
/// failure says that memory ran out, 2 for anything else.
[[noreturn]] void compile_and_exit(const std::string& source, std::size_t mb) {
  auto compiler = Compiler::create({});
  if (!compiler || !tests::limit_memory(mb << 20)) _exit(2);
  const auto object = compiler->compile(source, "unit.cpp");
  if (object) _exit(0);
  _exit(object.failure().exhausted && !object.failure().message.empty() ? 1 : 2);
}

TEST(OutOfMemoryDeathTest, IsAFailureLikeOthers) {
  if (!tests::memory_can_be_limited) GTEST_SKIP() << "memory cannot be limited here";
  // Processes begun anew: what earlier tests have freed does not help them out.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const std::string source = long_source(100);
  int succeeded = 0, failed = 0;
  // The compiler's stack takes 256 MB; what is left gives out here and there.
  for (std::size_t mb : {1, 100, 257, 259, 262, 266, 270, 275, 280, 290, 300, 2000}) {
    EXPECT_EXIT(
        compile_and_exit(source, mb),
        [&](int status) {
          if (!WIFEXITED(status)) return false;
          succeeded += WEXITSTATUS(status) == 0 ? 1 : 0;
          failed += WEXITSTATUS(status) == 1 ? 1 : 0;
          return WEXITSTATUS(status) <= 1;
        },
        "")
        << mb << " MB";
  }
  EXPECT_GT(succeeded, 0);
  EXPECT_GT(failed, 4);
}

TEST(ActivityDeathTest, ExitAsksAllToStopAndWaits) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        std::stop_source stop;
        std::thread([stop, activity = std::make_shared<Activity>(stop)] {
          while (!stop.stop_requested()) std::this_thread::yield();
          std::this_thread::sleep_for(std::chrono::milliseconds(50));
          std::fputs("stopped before the end\n", stderr);
        }).detach();
        if (!Activity::any()) _exit(1);
        std::exit(7);
      },
      testing::ExitedWithCode(7), "stopped before the end");
  EXPECT_FALSE(Activity::any());
}

TEST(ActivityDeathTest, AProcessMayEndWhileItCompiles) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  for (const int ms : {0, 1, 5, 20, 60}) {
    EXPECT_EXIT(
        {
          std::stop_source stop;
          std::thread([stop, activity = std::make_unique<Activity>(stop)] {
            auto compiler = Compiler::create({});
            while (compiler && compiler->compile(long_source(60), "unit.cpp", stop.get_token())) {
            }
          }).detach();
          std::this_thread::sleep_for(std::chrono::milliseconds(ms));
          std::exit(7);
        },
        testing::ExitedWithCode(7), "");
  }
}

}  // namespace
}  // namespace navjit::jit
