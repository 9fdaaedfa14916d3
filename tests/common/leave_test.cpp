#include "common/leave.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

#include "jit/activity.hpp"

namespace navjit::common {
namespace {

TEST(LeaveDeathTest, WaitsForNoCompilationAndLosesNoOutput) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        alarm(300);  // should it wait, it would for ever
        std::thread([activity = std::make_unique<jit::Activity>(std::stop_source())] {
          for (;;) pause();
        }).detach();
        setvbuf(stderr, nullptr, _IOFBF, BUFSIZ);
        std::fputs("the last line", stderr);
        leave(3);
      },
      testing::ExitedWithCode(3), "the last line");
  EXPECT_EXIT(leave(4), testing::ExitedWithCode(4), "");
}

}  // namespace
}  // namespace navjit::common
