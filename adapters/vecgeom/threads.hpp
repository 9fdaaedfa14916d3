// A navigator for each thread, behind calls that all threads make of one object.
#pragma once

#include <cstdint>
#include <memory>

#include "navjit/navigator.hpp"
#include "navjit/runtime.hpp"

namespace navjit::vecgeom {

/// Which of its navigators a thread used last.
struct LastNavigator {
  std::uint64_t owner = 0;  ///< 0: none
  Navigator* navigator = nullptr;
};

/// The navigators of one runtime, one for each thread that asked and lives. They are owned here. A
/// thread keeps only their addresses, under a number that no other object ever has, so that an
/// address is never used after its owner is gone. When a thread ends, its navigator waits for the
/// next new thread: programs that start and end threads do not collect navigators.
class ThreadNavigators {
 public:
  explicit ThreadNavigators(Runtime& runtime);
  ThreadNavigators(const ThreadNavigators&) = delete;
  ThreadNavigators& operator=(const ThreadNavigators&) = delete;
  ~ThreadNavigators();

  /// The calling thread's. Thread-safe; a comparison where the thread asked this object last.
  Navigator& mine() const {
    if (last.owner == number_) [[likely]]
      return *last.navigator;
    return find();
  }

 private:
  struct Pool;
  struct Leases;

  Navigator& find() const;
  static Leases& leases();

  // The only state outside objects, and none that anything depends on.
  static inline thread_local constinit LastNavigator last{};

  std::shared_ptr<Pool> pool_;
  std::uint64_t number_;
};

}  // namespace navjit::vecgeom
