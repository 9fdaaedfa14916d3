// A clock that is cheap to read, for the durations of single steps. Its unit does not matter.
#pragma once

#include <chrono>
#include <cstdint>

namespace navjit {

inline std::uint64_t ticks() {
#if defined(__x86_64__)
  return __builtin_ia32_rdtsc();
#else
  return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

}  // namespace navjit
