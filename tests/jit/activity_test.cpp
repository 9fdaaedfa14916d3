// Threads that work in LLVM when the process ends, and static objects that are made meanwhile.
#include "jit/activity.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <future>
#include <thread>

#include "jit/exiting.hpp"

namespace navjit::jit {
namespace {

/// An activity that takes a while to stop once it is asked to.
void begin_activity() {
  std::stop_source stop;
  std::thread([stop, activity = std::make_shared<Activity>(stop)] {
    while (!stop.stop_requested()) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }).detach();
}

/// A static object of LLVM's kind: it ends the process badly if something may still need it.
struct MadeOnTheWay {
  ~MadeOnTheWay() {
    if (Activity::any()) _exit(1);
  }
};

void make_static_object() { [[maybe_unused]] static const MadeOnTheWay object; }

TEST(ActivityDeathTest, WhatIsMadeLaterOutlastsItWhereTheThreadThatExitsHasSaidSo) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        std::thread([] {
          outlast_by_this_thread();
          begin_activity();
          make_static_object();
          std::exit(7);
        }).join();
      },
      testing::ExitedWithCode(7), "");
}

TEST(ActivityDeathTest, WhatIsMadeLaterOutlastsItWhereMainReturns) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        outlast_by_this_thread();
        std::thread([] { begin_activity(); }).join();
        make_static_object();
        std::exit(7);
      },
      testing::ExitedWithCode(7), "");
}

TEST(ActivityDeathTest, WhatWasMadeBeforeTheLastCallOutlastsItWhoeverExits) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        std::thread([] { begin_activity(); }).join();
        make_static_object();
        outlast_static_objects();
        std::thread([] { std::exit(7); }).join();
      },
      testing::ExitedWithCode(7), "");
}

TEST(Activity, IsNotWaitedForByAThreadThatOnlyEnds) {
  std::stop_source stop;
  {
    const Activity activity(stop);
    std::thread([] { outlast_by_this_thread(); }).join();
    EXPECT_FALSE(stop.stop_requested());
  }
  EXPECT_FALSE(Activity::any());
}

/// Tells, at the end of its thread, whether that ended because of exit().
struct Teller {
  std::promise<bool>* told = nullptr;
  ~Teller() {
    if (told != nullptr) {
      told->set_value(is_exiting());
    } else {
      _exit(is_exiting() ? 7 : 1);
    }
  }
};

TEST(ExitingDeathTest, IsKnownInDestructors) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_FALSE(is_exiting());
  std::promise<bool> told;
  std::thread([&] {
    static thread_local Teller teller;
    teller.told = &told;
  }).join();
  EXPECT_FALSE(told.get_future().get());
  EXPECT_EXIT(
      {
        std::thread([] {
          [[maybe_unused]] static thread_local const Teller teller;
          std::exit(2);
        }).join();
      },
      testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace navjit::jit
