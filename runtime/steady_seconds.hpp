// The clock of what a runtime does and when.
#pragma once

#include <chrono>

namespace navjit {

/// Since some fixed time, s; never goes back.
inline double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace navjit
