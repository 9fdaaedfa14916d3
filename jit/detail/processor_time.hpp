#pragma once

#include <pthread.h>
#include <time.h>

#include <atomic>

namespace navjit::jit::detail {

/// The total processor time, s, of threads that come and go. Thread-safe.
class ProcessorTime {
 public:
  /// The time of threads that have ended, and of the thread that is watched, if there is one.
  double seconds() const {
    const clockid_t clock = watched_.load();
    return gone_.load() + (clock == nobody ? 0 : read(clock));
  }

  static double of_this_thread() { return read(CLOCK_THREAD_CPUTIME_ID); }

  /// While it exists its thread is the one that is watched. The thread must not have done any work
  /// before.
  class Watched {
   public:
    explicit Watched(ProcessorTime& sum) : sum_(sum) {
      clockid_t clock = nobody;
      if (pthread_getcpuclockid(pthread_self(), &clock) == 0) sum_.watched_.store(clock);
    }
    Watched(const Watched&) = delete;
    Watched& operator=(const Watched&) = delete;
    ~Watched() {
      sum_.watched_.store(nobody);
      sum_.gone_.fetch_add(of_this_thread());
    }

   private:
    ProcessorTime& sum_;
  };

 private:
  static constexpr clockid_t nobody = CLOCK_REALTIME;  // does not belong to a thread

  /// The time of the clock, s; 0 if its thread has ended.
  static double read(clockid_t clock) {
    timespec time{};
    if (clock_gettime(clock, &time) != 0) return 0;
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  std::atomic<double> gone_{0};
  std::atomic<clockid_t> watched_{nobody};
};

}  // namespace navjit::jit::detail
