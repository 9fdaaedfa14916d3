// The time by which speed is judged. What other programs take of a busy machine does not count.
#pragma once

#include <time.h>

namespace navjit {

/// Seconds of a clock of clock_gettime(2).
inline double clock_seconds(clockid_t clock) {
  timespec now;
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// How long the calling thread has been running on a processor, s.
inline double thread_seconds() { return clock_seconds(CLOCK_THREAD_CPUTIME_ID); }

/// The same for all threads of the process together, including those that have ended.
inline double process_seconds() { return clock_seconds(CLOCK_PROCESS_CPUTIME_ID); }

}  // namespace navjit
