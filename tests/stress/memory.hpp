// The memory that this process uses.
#pragma once

#include <unistd.h>

#include <fstream>

namespace navjit::tests {

/// Resident memory, MB; 0 where the system does not tell it.
inline double resident_mb() {
  std::ifstream in("/proc/self/statm");
  double total = 0, resident = 0;
  in >> total >> resident;
  return in ? resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6 : 0;
}

}  // namespace navjit::tests
