// The clock of shared machines wanders, by a factor of two at times: figures in cycles compare
// where figures in nanoseconds do not.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "runtime/processor_time.hpp"
#include "runtime/ticks.hpp"

namespace navjit::common {

/// Time that this thread has been running, ns: what others take of a processor does not count.
inline double thread_ns() { return 1e9 * thread_seconds(); }

using navjit::ticks;

/// How long a tick is; measured once, in some 20 ms.
inline double ns_per_tick() {
  static const double value = [] {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const std::uint64_t first = ticks();
    while (Clock::now() - start < std::chrono::milliseconds(20)) {
    }
    const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
    return ns / static_cast<double>(ticks() - first);
  }();
  return value;
}

/// Cycles per nanosecond right now, from chains of integer multiplications, 3 cycles each on
/// x86-64 processors of the last ten years (A. Fog, "Instruction tables"). Takes some 50 us.
inline double cycles_per_ns() {
  constexpr int links = 10'000, chains = 5;
  double best = 0;
  for (int chain = 0; chain < chains; ++chain) {
    std::uint64_t x = 3;
    const double start = thread_ns();
    for (int i = 0; i < links; ++i) {
#if defined(__x86_64__)
      asm volatile("imulq %0, %0" : "+r"(x));
#else
      x *= x;
      asm volatile("" : "+r"(x));
#endif
    }
    best = std::max(best, 3.0 * links / (thread_ns() - start));
  }
  return best;
}

}  // namespace navjit::common
