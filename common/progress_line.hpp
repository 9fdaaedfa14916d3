// The line that shows how far a command is, on terminals only.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace navjit::common {

/// Columns of the terminal on standard error; 0 if that is none, or if the command was asked to be
/// quiet (the log's level says so).
std::size_t terminal_columns();

/// "42%, 3 s left": of so much, after so many seconds; without the time where nothing is known of
/// it yet, and empty where `total` is 0.
std::string percent_and_left(std::uint64_t done, std::uint64_t total, double seconds);

/// One line on standard error that is written anew some times a second, and gone at the end.
class ProgressLine {
 public:
  /// `what` is being done, in so many parts.
  ProgressLine(std::string what, std::uint64_t total);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  /// So many parts are done. By one thread at a time.
  void at(std::uint64_t done);

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  std::uint64_t total_;
  Clock::time_point start_ = Clock::now(), shown_ = start_;
  bool any_ = false;
};

}  // namespace navjit::common
