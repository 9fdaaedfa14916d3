// Makes a process unable to get more memory, for tests in a child.
#pragma once

#include <sys/resource.h>

#include <cstddef>
#include <fstream>

#include "tests/support/folder.hpp"

namespace navjit::tests {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool memory_can_be_limited = false;  // sanitizers map memory by the terabyte
#else
constexpr bool memory_can_be_limited = true;
#endif

/// From now on this process gets at most so many more bytes of address space.
inline bool limit_memory(std::size_t more_bytes) {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t bytes = pages * 4096 + more_bytes;
  const rlimit limit{bytes, bytes};
  return pages > 0 && setrlimit(RLIMIT_AS, &limit) == 0;
}

}  // namespace navjit::tests
