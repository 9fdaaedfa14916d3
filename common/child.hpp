// A program in a process of its own, that may crash or hang.
#pragma once

#include <string>
#include <vector>

namespace navjit::common {

struct ChildResult {
  enum class End { exited, crashed, timed_out, wrote_too_much, not_started };
  End end = End::not_started;
  int status = 0;      ///< exit status, or the signal that ended it
  std::string output;  ///< what it wrote to standard output; with more than 16 MB it is ended
  std::string error;  ///< the first 16 MB of standard error: messages, of which the rest is dropped

  bool good() const { return end == End::exited && status == 0; }
  /// Why it is not good, in words: "hangs (60 s)", "crashes (signal 11)", or its last line.
  std::string words(double seconds) const;
};

/// What a signal does that this process has noted (common/interruption.hpp).
enum class WhenInterrupted {
  end_it,  ///< the program is ended, and Interrupted is thrown
  go_on,   ///< nothing: it belongs to writing what there is
};

/// Runs a program (no shell; words[0] is its path) for at most so many seconds. Throws nothing but
/// Interrupted and std::bad_alloc.
ChildResult run_child(const std::vector<std::string>& words, double seconds,
                      WhenInterrupted when_interrupted = WhenInterrupted::end_it);

/// Tells the program that is being run to end, if there is one. May be called in a signal handler.
void end_child() noexcept;

}  // namespace navjit::common
