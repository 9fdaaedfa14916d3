// Runs that end while something is compiled, and runs that cannot compile, since threads or memory
// are lacking. Nothing waits, nothing fails, and no answer changes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <future>
#include <thread>

#include "jit/activity.hpp"
#include "tests/support/memory_limit.hpp"
#include "tests/support/traces.hpp"

#ifdef __SANITIZE_THREAD__
// A runtime that is never destroyed has a thread that nobody joins.
extern "C" [[gnu::visibility("default")]] const char* __tsan_default_options() {
  return "report_thread_leaks=0";
}
#endif

namespace navjit {
namespace {

using tests::eager_options;
using tests::rays_through;
using tests::same_bits;
using tests::trace;

/// A compilation that goes on until it is released.
struct SlowCompiler {
  std::promise<void> begun, released;
  std::atomic<bool> begun_already{false};

  static FaultyOptions options(const std::shared_ptr<SlowCompiler>& slow) {
    FaultyOptions o{eager_options(JitMode::on)};
    o.faults = std::make_shared<const Faults>(
        Faults{.compiling = [slow, go = slow->released.get_future().share()] {
          if (!slow->begun_already.exchange(true)) slow->begun.set_value();
          go.wait();
        }});
    return o;
  }
};

std::uint64_t transport_all(Runtime& runtime) {
  Navigator navigator = runtime.navigator();
  std::uint64_t steps = 0;
  for (const Ray& ray : rays_through(runtime.world(), 41, 400)) {
    steps += transport(navigator, ray, runtime.world().tolerance).steps;
  }
  return steps;
}

void wait_until_nothing_compiles() {
  while (jit::Activity::any()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(Ending, TheDestructorDoesNotWaitForTheCompiler) {
  const auto slow = std::make_shared<SlowCompiler>();
  std::weak_ptr<const World> world;
  {
    FaultyRuntime runtime(tests::mixed_world(), SlowCompiler::options(slow));
    world = runtime.share_world();
    transport_all(runtime);
    slow->begun.get_future().wait();
  }
  // Here it would hang if the destructor waited.
  EXPECT_TRUE(jit::Activity::any());
  EXPECT_FALSE(world.expired()) << "the compilation has what it works with";
  slow->released.set_value();
  wait_until_nothing_compiles();
  EXPECT_TRUE(world.expired());
}

TEST(Ending, TheFinalReportDoesNotWaitForTheCompiler) {
  const auto slow = std::make_shared<SlowCompiler>();
  {
    FaultyRuntime runtime(tests::mixed_world(), SlowCompiler::options(slow));
    const std::uint64_t steps = transport_all(runtime);
    slow->begun.get_future().wait();
    const RuntimeReport report = runtime.final_report();
    EXPECT_EQ(report.steps, steps);
    EXPECT_EQ(report.modules, 0U);
    EXPECT_GT(report.scenes.at(0).generic_ns_per_step, 0);
    EXPECT_FALSE(report.scenes.at(0).structure.empty());
    bool told = false;
    for (const SceneReport& scene : report.scenes) {
      EXPECT_EQ(scene.status, SceneStatus::generic) << scene.volume;
      told |= scene.note == "the run ended before it was compiled";
    }
    EXPECT_TRUE(told);
    EXPECT_FALSE(runtime.step_profile().volumes.empty());
    slow->released.set_value();
    wait_until_nothing_compiles();
    EXPECT_EQ(runtime.report().modules, 0U) << "what came of it is dropped";
    EXPECT_EQ(runtime.final_report().steps, steps);
    EXPECT_EQ(transport_all(runtime), steps) << "the runtime is still there to navigate";
  }
}

TEST(Ending, ManyRuntimesThatGoWhileTheyCompile) {
  for (int i = 0; i < 20; ++i) {
    Runtime runtime(tests::mixed_world(), eager_options(JitMode::on));
    transport_all(runtime);
    std::this_thread::sleep_for(std::chrono::milliseconds(5 * i));
  }
  wait_until_nothing_compiles();
}

TEST(EndingDeathTest, AProcessMayEndWhileARuntimeCompiles) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  for (const int ms : {0, 10, 40, 150}) {
    EXPECT_EXIT(
        {
          {
            Runtime runtime(tests::mixed_world(), eager_options(JitMode::on));
            transport_all(runtime);
            std::this_thread::sleep_for(std::chrono::milliseconds(ms));
          }
          std::exit(7);
        },
        testing::ExitedWithCode(7), "");
    EXPECT_EXIT(
        {
          static Runtime* const runtime =  // never destroyed
              new Runtime(tests::mixed_world(), eager_options(JitMode::on));
          transport_all(*runtime);
          std::this_thread::sleep_for(std::chrono::milliseconds(ms));
          std::exit(7);
        },
        testing::ExitedWithCode(7), "");
    EXPECT_EXIT(
        {
          std::thread other([ms] {
            static Runtime* const runtime =  // never destroyed
                new Runtime(tests::mixed_world(), eager_options(JitMode::on));
            transport_all(*runtime);
            std::this_thread::sleep_for(std::chrono::milliseconds(ms));
            std::exit(7);
          });
          other.join();
        },
        testing::ExitedWithCode(7), "");
  }
}

TEST(EndingDeathTest, AProcessMayEndWhileARuntimeSleeps) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        RuntimeOptions options;
        options.specialiser.poll_ms = 3.6e6;
        static Runtime* const runtime = new Runtime(tests::mixed_world(), options);
        runtime->wait_until_idle();  // and then it sleeps for an hour
        std::exit(7);
      },
      testing::ExitedWithCode(7), "");
}

/// A static object, as LLVM makes them while it compiles.
struct MadeWhileItCompiles {
  ~MadeWhileItCompiles() {
    if (jit::Activity::any()) _exit(1);
  }
};

TEST(EndingDeathTest, AThreadWithANavigatorMayEndTheProcess) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        static Runtime* const runtime =  // never destroyed
            new Runtime(tests::mixed_world(), eager_options(JitMode::on));
        [[maybe_unused]] static const MadeWhileItCompiles object;
        std::thread([] {
          transport_all(*runtime);
          std::exit(jit::Activity::any() ? 7 : 2);
        }).join();
      },
      testing::ExitedWithCode(7), "");
}

/// Whether a run with the JIT on has the same traces as one with it off; called in a child.
bool runs_as_ever(const RuntimeOptions& options, std::size_t more_bytes) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  const std::vector<Ray> rays = rays_through(*world, 43, 300);
  Runtime generic(world, eager_options(JitMode::off));
  std::vector<std::vector<tests::Row>> right;
  Navigator a = generic.navigator();
  for (const Ray& ray : rays) right.push_back(trace(a, ray, world->tolerance));
  if (!tests::limit_memory(more_bytes)) return false;
  Runtime runtime(world, options);
  Navigator b = runtime.navigator();
  for (int pass = 0; pass < 3; ++pass) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (!same_bits(right[i], trace(b, rays[i], world->tolerance))) return false;
    }
    runtime.wait_until_idle();
  }
  return !runtime.final_report().scenes.empty();
}

TEST(Exhausted, ARunGoesOnWithoutMemoryOrThreads) {
  if (!tests::memory_can_be_limited) GTEST_SKIP() << "memory cannot be limited here";
  // No thread at all, none for the compiler, and less than it takes to compile.
  for (const std::size_t mb : {4, 100, 280, 290, 300, 320, 350, 400, 1000}) {
    const int status =
        tests::in_child([&] { return runs_as_ever(eager_options(JitMode::on), mb << 20) ? 0 : 1; });
    ASSERT_TRUE(WIFEXITED(status)) << mb << " MB: signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 0) << mb << " MB";
  }
}

TEST(Exhausted, OneLineTellsOfIt) {
  for (const JitMode jit : {JitMode::on, JitMode::wait}) {
    testing::internal::CaptureStderr();
    FaultyOptions options{eager_options(jit)};
    options.faults =
        std::make_shared<const Faults>(Faults{.compiling = [] { throw std::bad_alloc(); }});
    FaultyRuntime runtime(tests::mixed_world(), options);
    transport_all(runtime);
    runtime.wait_until_idle();
    const RuntimeReport report = runtime.final_report();
    EXPECT_EQ(report.modules, 0U);
    for (const SceneReport& scene : report.scenes) {
      EXPECT_NE(scene.status, SceneStatus::specialised);
      EXPECT_NE(scene.status, SceneStatus::failed) << "it is not the scene's fault";
    }
    const std::string log = testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 1) << log;
    EXPECT_NE(log.find("nothing more is specialised in this run: out of memory"), std::string::npos)
        << log;
  }
}

}  // namespace
}  // namespace navjit
