// Marks that navigating threads set, so that replaced code is freed only once no thread is in it.
#pragma once

#include <atomic>
#include <cstdint>

#include "navjit/detail/api.hpp"

namespace NAVJIT_API navjit {

/// One navigating thread's mark: odd while it is inside a navigator.
struct alignas(64) ReadSide {
  std::atomic<std::uint64_t> sections{0};

  void enter() {
    sections.store(sections.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    std::atomic_signal_fence(std::memory_order_seq_cst);
  }
  void leave() {
    sections.store(sections.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }
};

}  // namespace navjit
