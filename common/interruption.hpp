// What the signals INT, TERM, HUP, XCPU, USR1 and USR2 do to the command. Batch systems send the
// last three to warn that a job's time is nearly over.
//
// A command that has nothing to finish ends at once, with exit status 128 + n. One that has is
// `Interruptible`: the first signal is noted, and the command looks for it between its pieces of
// work (a relaxed load), stops, writes what it has, and main exits with 128 + n. The second signal
// ends it at once. Either way temporary files are removed (files/temporary_path.hpp), and a
// program that run_child() waits for is told to end. Signals that were ignored when the process was
// started (nohup) stay ignored.
#pragma once

#include <exception>

namespace navjit::common {

/// Installs the handlers. Once, by main.
void watch_signals();

/// While there is one, the first signal is only noted.
class Interruptible {
 public:
  Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
  ~Interruptible();
};

/// The signal that was noted; 0 for none. From any thread.
int interruption() noexcept;

/// Notes a signal that came to another process of the run, as if it had come to this one while
/// signals are only noted.
void note_interruption(int signal) noexcept;

/// Thrown where there is nothing to be written: the way out through everything's destructors.
class Interrupted : public std::exception {
 public:
  explicit Interrupted(int signal) : signal_(signal) {}
  const char* what() const noexcept override { return "interrupted"; }
  int signal() const { return signal_; }

 private:
  int signal_;
};

/// Throws Interrupted if a signal was noted.
void stop_if_interrupted();

}  // namespace navjit::common
