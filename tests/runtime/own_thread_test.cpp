// The library's threads and the program's signals.
#include "runtime/own_thread.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/traces.hpp"

namespace navjit {
namespace {

/// The signals that a thread blocks, in the system's form: one bit for each, from 1 on.
std::uint64_t blocked(const std::filesystem::path& thread) {
  std::ifstream status(thread / "status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("SigBlk:")) return std::strtoull(line.c_str() + 7, nullptr, 16);
  }
  return 0;
}

constexpr std::uint64_t bit_of(int signal) { return std::uint64_t{1} << (signal - 1); }

TEST(OwnThread, TakesNoSignalOfTheProgram) {
  Runtime runtime(std::make_shared<const World>(tests::mixed_world()),
                  tests::eager_options(JitMode::on));
  runtime.wait_until_idle();  // by then its thread has begun
  const std::string mine = std::to_string(gettid());
  std::size_t others = 0;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
    const std::uint64_t signals = blocked(thread.path());
    const bool own = thread.path().filename() != mine;
    const bool all = (signals & bit_of(SIGTERM)) != 0,
               even_faults = (signals & bit_of(SIGSEGV)) != 0;
    if (own && (!all || even_faults))
      continue;  // a sanitizer's; how many others there are is checked
    others += own ? 1 : 0;
    for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGCHLD, SIGALRM, SIGPROF}) {
      EXPECT_EQ((signals & bit_of(signal)) != 0, own) << signal;
    }
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL}) {
      EXPECT_EQ(signals & bit_of(fault), 0U) << fault;
    }
  }
  EXPECT_EQ(others, 1U);
}

TEST(OwnThread, LeavesTheCallersSignalsAsTheyWere) {
  sigset_t before, after;
  pthread_sigmask(SIG_SETMASK, nullptr, &before);
  own_thread([] {}).join();
  pthread_sigmask(SIG_SETMASK, nullptr, &after);
  for (int signal = 1; signal < 32; ++signal) {
    EXPECT_EQ(sigismember(&before, signal), sigismember(&after, signal)) << signal;
  }
}

}  // namespace
}  // namespace navjit
