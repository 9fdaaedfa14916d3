// Threads that the library makes. Private to runtime/.
#pragma once

#include <csignal>
#include <thread>
#include <utility>

namespace navjit {

/// While one exists, the calling thread, and threads that it makes, receive no signals except those
/// that report their own faults. A program's signals are for the program's own threads, which may
/// wait for them by sigwait() or signalfd().
class WithoutSignals {
 public:
  WithoutSignals() {
    sigset_t others;
    sigfillset(&others);
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS}) {
      sigdelset(&others, fault);
    }
    pthread_sigmask(SIG_BLOCK, &others, &before_);
  }
  WithoutSignals(const WithoutSignals&) = delete;
  WithoutSignals& operator=(const WithoutSignals&) = delete;
  ~WithoutSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

/// A thread that receives no signal of the program. Throws what std::thread throws.
template <class... Work>
std::thread own_thread(Work&&... work) {
  const WithoutSignals without_signals;
  return std::thread(std::forward<Work>(work)...);
}

}  // namespace navjit
