#include "jit/over_fork.hpp"

#include <pthread.h>

#include <utility>

namespace navjit::jit {

/// There is one for the process, because fork() copies the whole process. It is never destroyed.
struct AllOverFork {
  std::mutex mutex;
  std::list<OverFork*> each;

  static AllOverFork& get() {
    static auto* const all = [] {
      pthread_atfork([] { get().lock(); }, [] { get().unlock(); },
                     [] {
                       for (const OverFork* one : get().each) {
                         if (one->in_child_) one->in_child_();
                       }
                       get().unlock();
                     });
      return new AllOverFork;
    }();
    return *all;
  }

  void lock() {
    mutex.lock();
    for (const OverFork* one : each) {
      for (std::mutex* lock : one->locks_) lock->lock();
    }
  }
  void unlock() {
    for (const OverFork* one : each) {
      for (std::mutex* lock : one->locks_) lock->unlock();
    }
    mutex.unlock();
  }
};

OverFork::OverFork(std::vector<std::mutex*> locks, std::function<void()> in_child)
    : locks_(std::move(locks)), in_child_(std::move(in_child)) {
  AllOverFork& all = AllOverFork::get();
  const std::lock_guard lock(all.mutex);
  place_ = all.each.insert(all.each.end(), this);
}

OverFork::~OverFork() {
  AllOverFork& all = AllOverFork::get();
  const std::lock_guard lock(all.mutex);
  all.each.erase(place_);
}

}  // namespace navjit::jit
