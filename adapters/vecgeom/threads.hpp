// A navigator for each thread, behind calls that all threads make of one object.
#pragma once

#include <cstdint>
#include <memory>

#include "navjit/navigator.hpp"
#include "navjit/runtime.hpp"

namespace navjit::vecgeom {

/// The navigator that a thread used last, and its owner.
struct LastNavigator {
  std::uint64_t owner = 0;  ///< 0: none
  Navigator* navigator = nullptr;
};

/// The navigators of one runtime: one for each thread that has asked and is still alive. This
/// object owns them. A thread keeps only their addresses, under a number that no other object ever
/// gets, so that no address is used after its owner is gone. When a thread ends, its navigator
/// waits for the next new thread: so programs that start and end threads do not collect navigators.
class ThreadNavigators {
 public:
  explicit ThreadNavigators(Runtime& runtime);
  ThreadNavigators(const ThreadNavigators&) = delete;
  ThreadNavigators& operator=(const ThreadNavigators&) = delete;
  ~ThreadNavigators();

  /// That of the calling thread. Thread-safe; a mere comparison if it asked this object last.
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

  // This is the only state outside objects, and no answer depends on it.
  static inline thread_local constinit LastNavigator last{};

  std::shared_ptr<Pool> pool_;
  std::uint64_t number_;
};

}  // namespace navjit::vecgeom
