// A program that makes a Runtime and forks: the thread that specialises stays in the parent, and
// nothing in the child waits for it.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <optional>

#include "tests/support/sanitizers.hpp"
#include "tests/support/traces.hpp"

namespace navjit {
namespace {

/// Whether a child that does this work ends without an error, and in time.
bool ends_well(const std::function<void()>& work) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);  // what hangs is killed
    work();
    const int status = ::testing::Test::HasFailure() ? 1 : 0;
    // At the end the sanitizer looks for leaks, and takes what the thread in the parent holds for
    // one.
    if (tests::under_address_sanitizer) _exit(status);
    std::exit(status);
  }
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(Fork, NothingInTheChildWaitsForAThreadOfTheParent) {
  if (tests::under_thread_sanitizer) GTEST_SKIP() << "it does not know threads in a forked child";
  const auto world = std::make_shared<const World>(tests::mixed_world());
  const std::vector<Ray> rays = tests::rays_through(*world, 5, 2000);
  std::optional<Runtime> runtime(std::in_place, world, tests::eager_options(JitMode::on));
  std::optional<Navigator> navigator(runtime->navigator());
  const auto transport_all = [&](Navigator& by) {
    std::uint64_t steps = 0;
    for (const Ray& ray : rays) steps += transport(by, ray, world->tolerance).steps;
    return steps;
  };
  const std::uint64_t steps = transport_all(*navigator);
  runtime->wait_until_idle();
  const std::size_t specialised = runtime->specialised();
  EXPECT_GT(specialised, 0U);

  EXPECT_TRUE(ends_well([] {})) << "it only ends";
  EXPECT_TRUE(ends_well([&] {
    EXPECT_EQ(transport_all(*navigator), steps);
    Navigator another = runtime->navigator();
    EXPECT_EQ(transport_all(another), steps);
    EXPECT_EQ(runtime->report().steps, 3 * steps);
    EXPECT_EQ(runtime->specialised(), specialised) << "what there was is still used";
    runtime->wait_until_idle();
    EXPECT_GE(runtime->step_profile().volumes.size(), runtime->report().scenes.size());
    EXPECT_EQ(runtime->final_report().steps, 3 * steps);
    EXPECT_EQ(runtime->final_report().steps, 3 * steps);
  }));
  EXPECT_TRUE(ends_well([&] {
    navigator.reset();
    runtime.reset();
  }));
  EXPECT_TRUE(ends_well([&] {
    Runtime own(world, tests::eager_options(JitMode::on));
    Navigator mine = own.navigator();
    EXPECT_EQ(transport_all(mine), steps);
    own.wait_until_idle();
    EXPECT_GT(own.final_report().modules, 0U) << "it compiles";
  }));
  EXPECT_EQ(transport_all(*navigator), steps) << "and the parent goes on";
  EXPECT_EQ(runtime->final_report().steps, 2 * steps);
}

}  // namespace
}  // namespace navjit
