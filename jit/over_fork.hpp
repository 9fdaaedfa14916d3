// Locks in the child of a fork(). It has a copy of the thread that forked, and of no other: what
// another thread had locked would stay locked there for ever.
#pragma once

#include <functional>
#include <list>
#include <mutex>
#include <vector>

namespace navjit::jit {

/// While one exists, fork() locks all of these first, in their order, and both processes unlock
/// them: so what they guard is whole in the child, too. Thread-safe.
class OverFork {
 public:
  /// Whoever locks several of them at once does so in this order. `in_child` is called there while
  /// they are locked. Throws std::bad_alloc.
  explicit OverFork(std::vector<std::mutex*> locks, std::function<void()> in_child = {});
  OverFork(const OverFork&) = delete;
  OverFork& operator=(const OverFork&) = delete;
  ~OverFork();

 private:
  std::list<OverFork*>::iterator place_;
  std::vector<std::mutex*> locks_;
  std::function<void()> in_child_;

  friend struct AllOverFork;
};

}  // namespace navjit::jit
