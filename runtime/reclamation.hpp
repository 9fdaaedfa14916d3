// When can replaced code be freed? When no thread can be in it. Navigating threads mark entry and
// exit by plain stores. The thread that frees code pays for the ordering, with a memory barrier on
// all threads of the process (membarrier(2)).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "navjit/detail/read_side.hpp"

namespace navjit {

/// Destroys things once every thread has left the read-side section in which it was when they were
/// retired. Not thread-safe: one owner makes all calls.
class RetireList {
 public:
  RetireList();

  /// Must be called after the last pointer to `garbage` was replaced. `threads` are those that may
  /// still be in it.
  void retire(std::shared_ptr<const void> garbage,
              const std::vector<std::shared_ptr<ReadSide>>& threads);
  /// Destroys what no thread can be using any more; returns how many things still wait.
  std::size_t reclaim();

 private:
  struct Wait {
    std::shared_ptr<ReadSide> thread;
    std::uint64_t section;  ///< the odd count that was seen, which has to change
  };
  struct Retired {
    std::shared_ptr<const void> garbage;
    std::vector<Wait> waits;
  };
  bool can_free_;  ///< false if the system has no membarrier: then everything waits for the
                   ///< destructor
  std::vector<Retired> retired_;
};

}  // namespace navjit
