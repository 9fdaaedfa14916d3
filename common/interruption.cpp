#include "common/interruption.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>

#include "common/child.hpp"
#include "files/temporary_path.hpp"

namespace navjit::common {
namespace {

// Handlers reach nothing but static storage.
std::atomic<int> noted{0};
std::atomic<int> interruptible{0};
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void on_signal(int signal) {
  int none = 0;
  if (interruptible.load() > 0 && noted.compare_exchange_strong(none, signal)) return;
  end_child();
  remove_temporary_paths();
  _exit(128 + signal);
}

}  // namespace

void watch_signals() {
  // Batch systems send the last three to warn that a job's time is nearly over.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1, SIGUSR2}) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

Interruptible::Interruptible() { ++interruptible; }
Interruptible::~Interruptible() { --interruptible; }

int interruption() noexcept { return noted.load(std::memory_order_relaxed); }

void note_interruption(int signal) noexcept {
  int none = 0;
  noted.compare_exchange_strong(none, signal);
}

void stop_if_interrupted() {
  if (const int signal = interruption()) throw Interrupted(signal);
}

}  // namespace navjit::common
