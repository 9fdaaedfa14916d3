#include "jit/activity.hpp"

#include <unistd.h>

#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <mutex>

#include "jit/over_fork.hpp"

namespace navjit::jit {
namespace {

/// Of the process, since exit() is. Never destroyed: the last thread leaves it when it will.
struct Registry {
  std::mutex mutex;
  std::condition_variable gone;
  std::list<std::stop_source> activities;
  /// The threads at work stay in the parent.
  OverFork over_fork{{&mutex}, [this] { activities.clear(); }};
};

Registry& registry() {
  static auto* const all = new Registry;
  return *all;
}

void wait_for_activities() {
  Registry& all = registry();
  std::unique_lock lock(all.mutex);
  for (std::stop_source& activity : all.activities) activity.request_stop();
  all.gone.wait(lock, [&] { return all.activities.empty(); });
}

}  // namespace

Activity::Activity(const std::stop_source& stop) {
  outlast_activities();
  Registry& all = registry();
  const std::lock_guard lock(all.mutex);
  place_ = all.activities.insert(all.activities.end(), stop);
}

Activity::~Activity() {
  Registry& all = registry();
  const std::lock_guard lock(all.mutex);
  all.activities.erase(place_);
  all.gone.notify_all();
}

bool Activity::any() {
  Registry& all = registry();
  const std::lock_guard lock(all.mutex);
  return !all.activities.empty();
}

namespace {

struct WaitWhenDestroyed {
  ~WaitWhenDestroyed() { wait_for_activities(); }
};

}  // namespace

// Functions given to atexit are called in reverse, static objects destroyed in between: those of
// LLVM that were made before this call outlive the wait. Objects of the thread that calls exit()
// are destroyed before all of these: so where it is the main thread, as in a return from main, it
// waits before anything of LLVM goes. Other threads must not wait when they end.
void outlast_activities() {
  std::atexit(wait_for_activities);
  if (gettid() == getpid()) {
    [[maybe_unused]] static thread_local const WaitWhenDestroyed at_the_end_of_main;
  }
}

void outlast_static_objects() {
  constexpr int enough = 4096;
  static std::atomic<int> calls{0};
  if (calls.load(std::memory_order_relaxed) < enough) {
    calls.fetch_add(1, std::memory_order_relaxed);
    std::atexit(wait_for_activities);
  }
}

}  // namespace navjit::jit
