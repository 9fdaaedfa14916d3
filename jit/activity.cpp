#include "jit/activity.hpp"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdlib>
#include <mutex>
#include <new>

#include "jit/exiting.hpp"
#include "jit/over_fork.hpp"

namespace navjit::jit {
namespace {

/// There is one for the process, because exit() ends the whole process. It is never destroyed,
/// since threads may use it to the last.
struct Registry {
  std::mutex mutex;
  std::condition_variable gone;
  std::list<std::stop_source> activities;
  /// The child of a fork() has no activities: the threads at work stay in the parent.
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

/// An object of each thread. In exit() it waits for the activities; if only its thread ends, it
/// does not wait.
struct WaitWhenDestroyed {
  ~WaitWhenDestroyed() {
    if (Activity::any() && (gettid() == getpid() || is_exiting())) wait_for_activities();
  }
};

/// The least time between two registrations by outlast_static_objects(), and their largest number.
/// Without these limits long compilations would make millions of them.
constexpr auto between_calls = std::chrono::microseconds(200);
constexpr int most_calls = 1 << 15;

/// Bytes: more than glibc needs to register the destructor of a thread-local object, and too many
/// to end up in its per-thread cache of freed memory, from which that registration could not take
/// them.
constexpr std::size_t more_than_noted = 4096;

}  // namespace

void outlast_by_this_thread() {
  // glibc ends the process if it has no memory to register the destructor below. So as much memory
  // is allocated and freed first, which throws if there is none.
  static thread_local bool tried = false;
  if (!tried) ::operator delete(::operator new(more_than_noted));
  tried = true;
  [[maybe_unused]] static thread_local const WaitWhenDestroyed at_its_end;
}

// Functions given to atexit() are called in reverse order, and static objects are destroyed in
// between. So static objects of LLVM that were made before this call are destroyed after the wait.
// Thread-local objects of the thread that calls exit() are destroyed before all of these, so the
// one of this thread waits before anything of LLVM is destroyed, whenever that was made.
void outlast_activities() {
  std::atexit(wait_for_activities);
  outlast_by_this_thread();
}

void outlast_static_objects() {
  static std::atomic<std::chrono::steady_clock::rep> last{0};
  static std::atomic<int> calls{0};
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  const std::chrono::steady_clock::duration before(last.load(std::memory_order_relaxed));
  if (now - before < between_calls || calls.load(std::memory_order_relaxed) >= most_calls) return;
  last.store(now.count(), std::memory_order_relaxed);
  calls.fetch_add(1, std::memory_order_relaxed);
  std::atexit(wait_for_activities);
}

}  // namespace navjit::jit
