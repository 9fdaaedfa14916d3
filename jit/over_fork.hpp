// Locks in the child of a fork(). The child has a copy of the thread that called fork(), and of no
// other. A lock that another thread held would stay locked in the child for ever.
#pragma once

#include <functional>
#include <list>
#include <mutex>
#include <vector>

namespace navjit::jit {

/// While one exists, fork() first locks all of its mutexes in their order, and both processes
/// unlock them. So the data that they guard is consistent in the child, too. Thread-safe.
class OverFork {
 public:
  /// Code that locks several of these mutexes must do so in this order. `in_child` is called in the
  /// child while they are locked. Throws std::bad_alloc.
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
