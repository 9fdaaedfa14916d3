// The clock for the times at which a runtime does something.
#pragma once

#include <chrono>

namespace navjit {

/// The time since some fixed moment, s. It never goes back.
inline double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace navjit
