#include "jit/activity.hpp"

#include <condition_variable>
#include <cstdlib>
#include <mutex>

namespace navjit::jit {
namespace {

/// Of the process, since exit() is. Never destroyed: the last thread leaves it when it will.
struct Registry {
  std::mutex mutex;
  std::condition_variable gone;
  std::list<std::stop_source> activities;
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

// Functions given to atexit are called in reverse, static objects destroyed in between: those of
// LLVM that were made before this call outlive the wait.
void outlast_activities() { std::atexit(wait_for_activities); }

}  // namespace navjit::jit
