// Time by which speed is judged: what others take of a busy machine does not count.
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

/// The same of all threads of the process together, those that have ended included.
inline double process_seconds() { return clock_seconds(CLOCK_PROCESS_CPUTIME_ID); }

}  // namespace navjit
